#pragma once

#include "core/light/clip.h"
#include "core/light/polygon_shape.h"

// A polygon light as it is seen from a shading point, and the distributions it is integrated
// against.

namespace penumbra {

// ---- the distributions -----------------------------------------------------------------------

// The clamped cosine itself.
template <class F>
struct CosineLobe {
    static constexpr bool kTransforms = false;
    Vec3<F> normal;
    [[nodiscard]] Vec3<F> direction(const Vec3<F>& v) const { return v; }
    [[nodiscard]] F height(const Vec3<F>& direction_) const { return dot(normal, direction_); }
    [[nodiscard]] Vec3<F> flux() const { return normal; }
    [[nodiscard]] F determinant() const { return F(1); }
};

// A clamped cosine after a linear map: `row_*` take a world-space vector to the space where the
// distribution is the clamped cosine around z (the inverse matrix of the table times the shading
// frame). Any scale; the determinant must be positive, and `row_z` a positive multiple of the
// normal, so that the distribution's horizon is the surface's.
template <class F>
struct TransformedLobe {
    static constexpr bool kTransforms = true;
    Vec3<F> row_x, row_y, row_z;
    F map_determinant;
    [[nodiscard]] Vec3<F> direction(const Vec3<F>& v) const {
        return {dot(row_x, v), dot(row_y, v), dot(row_z, v)};
    }
    [[nodiscard]] F height(const Vec3<F>& direction_) const { return direction_.z; }
    [[nodiscard]] F determinant() const { return map_determinant; }
};

// ---- a light as seen from a point ------------------------------------------------------------

template <class F>
struct SeenPolygon {
    Vec3<F> vertices[kMaxPolygonVertices];  // relative to the point
    F heights[kMaxPolygonVertices];         // above the point's horizon
    Vec3<F> center;                         // relative to the point
    F distance;           // of the point from the light's plane, on the emitting side: >= 0
    F winding;            // -1 where the vertices run counter-clockwise as seen from the point
    simd::MaskOf<F> lit;  // the light emits towards the point and is not below its horizon
    simd::MaskOf<F> crosses_horizon;
};

namespace detail {

template <class F, class T>
Vec3<F> in_lanes(const Vec3<T>& v) {
    return {F(v.x), F(v.y), F(v.z)};
}

}  // namespace detail

// `point` and `normal` (unit) in world space.
template <class F, class T>
SeenPolygon<F> see_polygon(const PolygonShape<T>& light, const Vec3<F>& point,
                           const Vec3<F>& normal) {
    SeenPolygon<F> seen;
    const F tolerance = F(light.plane_tolerance);
    F highest = F(0);
    F lowest = F(0);
    for (int i = 0; i < light.count; ++i) {
        seen.vertices[i] = detail::in_lanes<F>(light.vertices[i]) - point;
        seen.heights[i] = dot(normal, seen.vertices[i]);
        highest = simd::max(seen.heights[i], highest);
        lowest = simd::min(seen.heights[i], lowest);
    }
    seen.center = detail::in_lanes<F>(light.center) - point;
    const F distance = -dot(detail::in_lanes<F>(light.normal), seen.center);
    seen.distance = light.two_sided ? simd::abs(distance) : distance;
    seen.winding = simd::select(distance < F(0), F(1), F(-1));
    seen.lit = (seen.distance > tolerance) & (highest > tolerance);
    seen.crosses_horizon = lowest < F(0);
    return seen;
}

}  // namespace penumbra
