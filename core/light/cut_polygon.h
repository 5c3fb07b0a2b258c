#pragma once

#include "core/light/polygon_edges.h"

// The integral over the part of a polygon that lies above the point's horizon.

namespace penumbra::detail {

// The part above the true horizon, as offsets from the first vertex. The same for all lobes:
// clipped when the first of them asks, recognised by its count.
template <class F, class T>
const ClippedPolygon<F>& horizon_part(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                                      ClippedPolygon<F>& above) {
    if (above.count != 0) return above;
    Vec3<F> offsets[kMaxPolygonVertices];
    for (int i = 0; i < light.count; ++i) offsets[i] = in_lanes<F>(light.offsets[i]);
    clip_by_heights(offsets, seen.heights, light.count, above);
    return above;
}

template <class F, class Lobe>
F clipped_edge_sum(const ClippedPolygon<F>& part, const Vec3<F>& origin, const Lobe& lobe) {
    Vec3<F> directions[kMaxClippedVertices];
    F weights[kMaxClippedVertices];
    directions[0] = lobe.direction(origin + part.vertices[0]);
    for (int i = 1; i < part.count; ++i) directions[i] = lobe.direction(origin + part.vertices[i]);
    edge_weights(directions, part.count, weights);
    Vec3<F> edges{F(0), F(0), F(0)};
    Vec3<F> moments{F(0), F(0), F(0)};
    for (int i = 0; i < part.count; ++i) {
        const int next = i + 1 < part.count ? i + 1 : 0;
        const Vec3<F> edge = part.vertices[next] - part.vertices[i];
        edges = fma(edge, weights[i], edges);
        moments = fma(cross(part.vertices[i], edge), weights[i], moments);
    }
    const Vec3<F> flux = lobe.flux();
    return dot(edges, cross(flux, origin)) + dot(flux, moments);
}

// Dunavant's six points on each triangle of the fan.
template <class F, class T, class Lobe>
F clipped_small_form_factor(const PolygonShape<T>& light, const ClippedPolygon<F>& part,
                            const SeenPolygon<F>& seen, const Lobe& lobe) {
    const Vec3<F> normal = in_lanes<F>(light.normal);
    F total = F(0);
    for (int i = 1; i + 1 < part.count; ++i) {
        const Vec3<F> a = part.vertices[0];
        const Vec3<F> b = part.vertices[i] - a;
        const Vec3<F> c = part.vertices[i + 1] - a;
        F mean = F(0);
        for (int ring = 0; ring < 2; ++ring) {
            const F place = F(T(kDunavantPlace[ring]));
            const F rest = F(T(1) - T(2) * T(kDunavantPlace[ring]));
            const Vec3<F> origin = seen.vertices[0] + a;
            const F sum = point_kernel(lobe, lobe.direction(origin + (b + c) * place)) +
                          point_kernel(lobe, lobe.direction(origin + fma(b, rest, c * place))) +
                          point_kernel(lobe, lobe.direction(origin + fma(c, rest, b * place)));
            mean = simd::fma(sum, F(T(kDunavantWeight[ring])), mean);
        }
        total = simd::fma(mean, simd::max(dot(normal, cross(b, c - b)), F(0)), total);
    }
    return total * (seen.distance * lobe.determinant()) * F(T(0.5 * 0.318309886183790672));
}

template <class F, class T, class Lobe>
F cut_form_factor(const PolygonShape<T>& light, const SeenPolygon<F>& seen, const Lobe& lobe,
                  const simd::MaskOf<F>& small, const ClippedPolygon<F>& above) {
    F result = clipped_edge_sum(above, seen.vertices[0], lobe) *
               (seen.winding * F(T(0.5 * 0.318309886183790672)));
    if (simd::any(small))
        result = simd::select(small, clipped_small_form_factor(light, above, seen, lobe), result);
    return simd::select(above.visible, result, F(0));
}

}  // namespace penumbra::detail
