#pragma once

#include <cstdint>

#include "core/frame/camera.h"

// Vertices on the pixel grid: coverage is decided by these integers alone.

namespace penumbra::raster {

// Coordinates count 1/256 pixels from the frame's top left, 24 bits with sign: the guard band
// reaches 32767 pixels to every side of that corner.
inline constexpr int kSubpixelBits = 8;
inline constexpr int kSubpixels = 1 << kSubpixelBits;
inline constexpr std::int32_t kMaxSnapped = (1 << 23) - kSubpixels;
inline constexpr float kGuardBand = static_cast<float>(kMaxSnapped) / kSubpixels;  // pixels

// A vertex that is not inside near plane and guard band has no place on the grid: its x is then
// kUnsnappable + the planes it is outside of, as bits of Outcode.
struct SnappedVertex {
    std::int32_t x, y;
    friend bool operator==(const SnappedVertex&, const SnappedVertex&) = default;
};
inline constexpr std::int32_t kUnsnappable = INT32_MIN;
inline constexpr std::int32_t kLargestUnsnappable = INT32_MIN + 255;

enum Outcode : std::int32_t {
    kBeforeNear = 1,
    kLeftOfGuardBand = 2,
    kRightOfGuardBand = 4,
    kAboveGuardBand = 8,
    kBelowGuardBand = 16,
};

// The signed distances of a view-space point from the five clip planes, each up to a factor; inside
// is >= 0. Everybody who asks "inside?" must compute this and nothing else, or neighbours disagree.
template <class F>
struct ClipDistances {
    F near_plane, left, right, top, bottom;
};
template <class F>
ClipDistances<F> clip_distances(const Camera& camera, const Vec3<F>& view) {
    const F x = simd::fma(F(camera.focal), view.x, F(camera.center_x) * view.z);
    const F y = simd::fma(F(-camera.focal), view.y, F(camera.center_y) * view.z);
    const F reach = F(kGuardBand) * view.z;
    return {view.z - F(camera.near_distance), reach + x, reach - x, reach + y, reach - y};
}

// A pixel coordinate on the grid. Rounding may leave the guard band by an ulp: clamped.
template <class F>
simd::IntOf<F> snap(F pixels) {
    const F limit(static_cast<float>(kMaxSnapped));
    return simd::to_int(simd::clamp(simd::round(pixels * F(kSubpixels)), -limit, limit));
}

}  // namespace penumbra::raster
