#pragma once

#include "core/light/polygon_edges.h"
#include "core/light/seen_polygon.h"

// A polygon light as a linearly transformed cosine sees it: what of it lies above the horizon, in
// the space where the distribution is the clamped cosine.

namespace penumbra {

// As in ClippedPolygon, lanes that need fewer slots than others repeat a vertex, bit for bit.
template <class F>
struct CosinePolygon {
    int count = 0;
    Vec3<F> vertices[kMaxClippedVertices];  // unit vectors with z >= 0
    F winding;  // 1 where the vertices run counter-clockwise around the light's directions, else -1
    Vec3<F> irradiance;  // twice the vector irradiance: its z is that of the clamped cosine
    Vec3<F> inside;      // a unit vector within the polygon: along it, as far as rounding allows
};

namespace detail {

// As edge_weights, of unit vectors.
template <class F>
void unit_edge_weights(const Vec3<F>* vertices, int count, F* weights) {
    F cosines[kMaxClippedVertices];
    F least = F(1);
    for (int i = 0; i < count; ++i) {
        cosines[i] = dot(vertices[i], vertices[i + 1 == count ? 0 : i + 1]);
        weights[i] = arc_over_sine(simd::abs(cosines[i]));
        least = simd::min(cosines[i], least);
    }
    if (simd::none(least < F(0))) return;
    for (int i = 0; i < count; ++i)
        weights[i] = simd::select(cosines[i] < F(0),
                                  obtuse_arc_over_sine(weights[i], vertices[i],
                                                       vertices[i + 1 == count ? 0 : i + 1], F(1)),
                                  weights[i]);
}

// The mean of the edges' middles, each by its squared length: rounds well for the smallest and the
// thinnest of polygons, and repeated vertices do not count.
template <class F>
struct Outline {
    Vec3<F> center;
    F squared_extent;  // the longest edge's
};

template <class F>
Outline<F> outline_of(const CosinePolygon<F>& polygon) {
    Vec3<F> sum{F(0), F(0), F(0)};
    F longest = F(0);
    for (int i = 0; i < polygon.count; ++i) {
        const Vec3<F>& a = polygon.vertices[i];
        const Vec3<F>& b = polygon.vertices[i + 1 < polygon.count ? i + 1 : 0];
        const F squared = length_squared(b - a);
        sum = fma(a + b, squared + F(1e-18f), sum);
        longest = simd::max(squared, longest);
    }
    return {sum * inverse_length(sum), longest};
}

// Lambert's formula for the vector: half the sum of the edges' normals times their arcs. Its
// direction is off by about 1e-7 extent / length: where that is not small against the polygon, the
// outline's center takes its place.
template <class F>
void integrate_irradiance(CosinePolygon<F>& polygon) {
    F weights[kMaxClippedVertices];
    unit_edge_weights(polygon.vertices, polygon.count, weights);
    Vec3<F> sum{F(0), F(0), F(0)};
    for (int i = 0; i < polygon.count; ++i) {
        const Vec3<F>& a = polygon.vertices[i];
        const Vec3<F>& b = polygon.vertices[i + 1 < polygon.count ? i + 1 : 0];
        sum = fma(cross(a, b - a), weights[i] * polygon.winding, sum);
    }
    // Slivers at the horizon may round to below.
    sum.z = simd::max(sum.z, F(0));
    polygon.irradiance = sum;
    const Outline<F> outline = outline_of(polygon);
    const F squared_length = length_squared(sum);
    // From 0.02 to 0.04 of the extent.
    const F trusted = simd::saturate(simd::fma(
        F(800), squared_length / simd::max(outline.squared_extent, F(1e-30f)), F(-0.32f)));
    const Vec3<F> along = sum * inverse_length(sum);
    const Vec3<F> inside = fma(along - outline.center, trusted, outline.center);
    polygon.inside = inside * inverse_length(inside);
}

}  // namespace detail

// `above` is the light's part above the horizon as offsets from its first vertex; only read where
// the horizon cuts the light in some lane.
template <class F, class T>
void make_cosine_polygon(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                         const TransformedLobe<F>& lobe, const ClippedPolygon<F>& above,
                         CosinePolygon<F>& polygon) {
    const bool is_cut = simd::any(seen.lit & seen.crosses_horizon);
    polygon.count = is_cut ? above.count : light.count;
    polygon.winding = seen.winding;
    for (int i = 0; i < polygon.count; ++i) {
        Vec3<F> direction = lobe.direction(seen.vertices[i < light.count ? i : light.count - 1]);
        if (is_cut)
            direction = select(seen.crosses_horizon,
                               lobe.direction(seen.vertices[0] + above.vertices[i]), direction);
        // Rounding may leave cut vertices a little below.
        direction.z = simd::max(direction.z, F(0));
        polygon.vertices[i] = direction * detail::inverse_length(direction);
    }
    detail::integrate_irradiance(polygon);
}

}  // namespace penumbra
