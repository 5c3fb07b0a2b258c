#pragma once

#include "core/math/vec.h"

namespace penumbra {

// x -> linear * x + translation; the columns of `linear` are the images of the axes.
template <class F>
struct Affine {
    Vec3<F> column_x{1, 0, 0}, column_y{0, 1, 0}, column_z{0, 0, 1}, translation{0, 0, 0};

    [[nodiscard]] Vec3<F> vector(const Vec3<F>& v) const {
        return fma(column_x, v.x, fma(column_y, v.y, column_z * v.z));
    }
    [[nodiscard]] Vec3<F> point(const Vec3<F>& p) const {
        return fma(column_x, p.x, fma(column_y, p.y, fma(column_z, p.z, translation)));
    }
    friend bool operator==(const Affine& a, const Affine& b) {
        const auto same = [](const Vec3<F>& u, const Vec3<F>& v) {
            return u.x == v.x && u.y == v.y && u.z == v.z;
        };
        return same(a.column_x, b.column_x) && same(a.column_y, b.column_y) &&
               same(a.column_z, b.column_z) && same(a.translation, b.translation);
    }
};

// The same map in every lane.
template <class F>
Affine<F> broadcast(const Affine<float>& a) {
    return {broadcast<F>(a.column_x), broadcast<F>(a.column_y), broadcast<F>(a.column_z),
            broadcast<F>(a.translation)};
}

using Affine3f = Affine<float>;

}  // namespace penumbra
