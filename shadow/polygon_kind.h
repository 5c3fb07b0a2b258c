#pragma once

#include <optional>

#include "core/frame/camera.h"
#include "core/frame/tile.h"
#include "core/light/lobe_ratio.h"
#include "core/light/polygon.h"
#include "core/sampling/polygon.h"
#include "shadow/light_bounds.h"
#include "shadow/ray_origin.h"

// The light that is a convex, planar polygon. See shadow/light_kinds.h.

namespace penumbra {

template <class Shape, class F>
struct LightTypes;
template <class T, class F>
struct LightTypes<PolygonShape<T>, F> {
    using Seen = SeenPolygon<F>;
    using InCosineSpace = CosinePolygon<F>;
    using Sampler = PolygonSampler<F>;
};

template <class F>
SeenPolygon<F> see(const PolygonShape<float>& shape, const Vec3<F>& point, const Vec3<F>& normal) {
    return see_polygon(shape, point, normal);
}

// ---- points on it ----------------------------------------------------------------------------

template <class F>
PolygonSampler<F> measure(const PolygonShape<float>& shape, const SeenPolygon<F>& seen) {
    return make_polygon_sampler(shape, seen);
}

template <class F>
simd::MaskOf<F> has_places(const PolygonSampler<F>& sampler) {
    return sampler.solid_angle > F(0);
}

template <class F>
Vec3<F> begin_place(const PolygonShape<float>& shape, const SeenPolygon<F>& seen,
                    const PolygonSampler<F>& sampler, const F& random) {
    return choose_opposite(shape, seen, sampler, random);
}

template <class F>
Vec3<F> end_place(const PolygonShape<float>&, const SeenPolygon<F>& seen,
                  const PolygonSampler<F>& sampler, const Vec3<F>& begun, const F& random) {
    return choose_between(seen, sampler, begun, random);
}

// Per steradian; the lanes in `where` have places.
template <class F>
F place_density(const PolygonShape<float>&, const SeenPolygon<F>&, const PolygonSampler<F>& sampler,
                const Vec3<F>&, const simd::MaskOf<F>& where) {
    return F(1) / simd::select(where, sampler.solid_angle, F(1));
}

template <class F>
PolygonHit<F> intersect(const PolygonShape<float>& shape, const SeenPolygon<F>& seen,
                        const Vec3<F>& direction) {
    return intersect_polygon(shape, seen, direction);
}

template <class F>
Vec3<F> place_origin(const SeenPolygon<F>& seen) {
    return seen.vertices[0];
}
template <class F>
Vec3<F> place_origin(const PolygonShape<float>& shape) {
    return broadcast<F>(shape.vertices[0]);
}

// Rays end this many times the light's radius above its plane, at least: faces of one light lie in
// its plane up to the tolerance with which they were merged, and must not shadow it.
inline constexpr float kMarginPerRadius = 1e-5f;

// As a share of the way from a ray's origin to a place of the light; `to_origin` is the way to
// place_origin.
template <class F>
F end_of_ray(const PolygonShape<float>& shape, const Vec3<F>& to_origin) {
    const F margin(shape.plane_tolerance + kMarginPerRadius * shape.radius);
    return range_to_light(simd::abs(dot(broadcast<F>(shape.normal), to_origin)), margin);
}

// ---- seen from the eye -----------------------------------------------------------------------

template <class Shape>
struct LightOutline;
template <>
struct LightOutline<PolygonShape<float>> {
    int edge_count;
    Vec3f
        edge_normals[kMaxPolygonVertices];  // a direction meets the light if no dot product is < 0
    Vec3f normal;                           // unit, towards the viewer
    float plane_distance;                   // normal . (point of the light - eye), < 0
};
using PolygonOutline = LightOutline<PolygonShape<float>>;

// Nothing where the eye sees no emitting side.
[[nodiscard]] std::optional<PolygonOutline> see_outline(const PolygonShape<float>& shape,
                                                        const Vec3f& eye);

// Can the light not touch the tile's pixels? A light that reaches behind the near plane always may.
[[nodiscard]] bool misses_tile(const PolygonShape<float>& shape, const Camera& camera,
                               const Tile& tile);

template <class F>
simd::MaskOf<F> covers(const PolygonOutline& outline, const Vec3<F>& direction) {
    simd::MaskOf<F> inside = direction.x == direction.x;
    for (int i = 0; i < outline.edge_count; ++i)
        inside &= dot(broadcast<F>(outline.edge_normals[i]), direction) >= F(0);
    return inside;
}

// Directions advance by 1 along the view axis, so the ray's parameter is the depth.
template <class F>
F outline_depth(const PolygonOutline& outline, const Vec3<F>& direction) {
    return F(outline.plane_distance) / dot(broadcast<F>(outline.normal), direction);
}

}  // namespace penumbra
