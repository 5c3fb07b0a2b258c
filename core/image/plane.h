#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

// Planes: images of one number per pixel, stored so that kernels need no tails.

namespace penumbra {

// Every row of a plane starts on a cache line and is padded to a multiple of this many elements, so
// that a kernel may load and store whole vectors (16 lanes) up to the padded end of a row.
inline constexpr int kRowPadding = 64;

// Pixels of a plane or of a part of it, addressed from its own top left. Points at tile scratch or
// into a full-frame plane: who reads it cannot tell.
template <class T>
struct PlaneView {
    T* origin = nullptr;
    std::ptrdiff_t stride = 0;  // elements from one row to the next

    [[nodiscard]] T* row(int y) const { return origin + y * stride; }
    [[nodiscard]] T& at(int x, int y) const { return row(y)[x]; }
    [[nodiscard]] PlaneView offset(int x, int y) const { return {row(y) + x, stride}; }
    [[nodiscard]] explicit operator bool() const { return origin != nullptr; }
    operator PlaneView<const T>() const requires(!std::is_const_v<T>) { return {origin, stride}; }
};

// Three planes, for colours and vectors.
template <class T>
using PlaneView3 = std::array<PlaneView<T>, 3>;

template <class T>
PlaneView3<const T> to_const(const PlaneView3<T>& v) {
    return {v[0], v[1], v[2]};
}

template <class T>
class Plane {
  public:
    Plane() = default;
    // Zero-filled. The padding belongs to the allocation, rows and columns alike: height is padded
    // to a multiple of `kRowPadding` too, so that whole tiles can be written everywhere.
    Plane(int width, int height)
        : width_(width),
          height_(height),
          stride_(padded(width)),
          data_(allocate(static_cast<std::size_t>(padded(width)) * padded(height))) {}

    [[nodiscard]] bool empty() const { return data_ == nullptr; }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
    [[nodiscard]] std::size_t allocated_elements() const {
        return static_cast<std::size_t>(stride_) * padded(height_);
    }
    [[nodiscard]] T* row(int y) { return data_.get() + y * stride_; }
    [[nodiscard]] const T* row(int y) const { return data_.get() + y * stride_; }
    [[nodiscard]] T& at(int x, int y) { return row(y)[x]; }
    [[nodiscard]] const T& at(int x, int y) const { return row(y)[x]; }
    [[nodiscard]] PlaneView<T> view() { return {data_.get(), stride_}; }
    [[nodiscard]] PlaneView<const T> view() const { return {data_.get(), stride_}; }
    void fill(T value) { std::fill_n(data_.get(), allocated_elements(), value); }

  private:
    static constexpr std::size_t kAlignment = 64;
    struct Release {
        void operator()(T* p) const { ::operator delete[](p, std::align_val_t(kAlignment)); }
    };
    static int padded(int n) { return (n + kRowPadding - 1) / kRowPadding * kRowPadding; }
    static std::unique_ptr<T[], Release> allocate(std::size_t count) {
        if (count == 0) return nullptr;
        T* p = static_cast<T*>(::operator new[](count * sizeof(T), std::align_val_t(kAlignment)));
        std::fill_n(p, count, T{});
        return std::unique_ptr<T[], Release>(p);
    }

    int width_ = 0;
    int height_ = 0;
    std::ptrdiff_t stride_ = 0;
    std::unique_ptr<T[], Release> data_;
};

template <class T>
using Plane3 = std::array<Plane<T>, 3>;

template <class T>
Plane3<T> make_plane3(int width, int height) {
    return {Plane<T>(width, height), Plane<T>(width, height), Plane<T>(width, height)};
}
template <class T>
PlaneView3<T> view(Plane3<T>& p) {
    return {p[0].view(), p[1].view(), p[2].view()};
}
template <class T>
PlaneView3<const T> view(const Plane3<T>& p) {
    return {p[0].view(), p[1].view(), p[2].view()};
}

}  // namespace penumbra
