#pragma once

#include "core/math/vec.h"

// Where shadow rays begin and end, so that neither the surface they leave nor the light they go to
// blocks them through rounding.

namespace penumbra {

// Metres per metre. Rounding moves a point off its triangle by a few units in the last place
// (2^-24) of the largest number that went into it; 2^-20 is sixteen of those.
inline constexpr float kOffsetPerMagnitude = 0x1p-20f;
// Of the distance from the eye: a two-hundredth of a pixel at 1080p. Covers what scales with the
// picture and not with the coordinates, such as interpolated normals.
inline constexpr float kOffsetPerDistance = 0x1p-18f;
// Rays end this share of their length before the light.
inline constexpr float kRangeShortfall = 0x1p-16f;

// Moves `point` off its surface along the geometric normal, towards the viewer, whatever the side
// of the light: a light below the facet's plane is then blocked by the facet itself, also on open
// sheets. Smooth-shaded silhouettes stay smooth, because `point` has been moved off the facet far
// enough for the rays of a light that is above the smooth surface's horizon
// (Surface::shadow_origin). `scale` is the size of the numbers its triangle was made of. After
// Waechter and Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems
// (2019), ch. 6; differs: the offset is isotropic and knows the triangle's size, since a point near
// the world's origin on a large triangle has the triangle's error, not its own.
template <class F>
Vec3<F> offset_origin(const Vec3<F>& point, const Vec3<F>& geometric_normal, F scale,
                      const Vec3<F>& eye) {
    const F magnitude =
        simd::max(simd::max(simd::abs(point.x), simd::abs(point.y)), simd::abs(point.z)) + scale;
    const F distance = length(point - eye);
    const F offset = simd::fma(magnitude, F(kOffsetPerMagnitude), distance * F(kOffsetPerDistance));
    return fma(geometric_normal, offset, point);
}

// The end of a ray, as a share of the way to a point of a light's plane, for an origin `height`
// metres from that plane: all but a small share, and at least `margin` metres short of the plane.
template <class F>
F range_to_light(F height, F margin) {
    const F shortfall = simd::max(F(kRangeShortfall), margin / simd::max(height, F(1e-30f)));
    return simd::max(F(1) - shortfall, F(0));
}

}  // namespace penumbra
