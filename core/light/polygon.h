#pragma once

#include "core/light/cosine_polygon.h"
#include "core/light/cut_polygon.h"

// Closed forms for the light of a convex polygon of constant radiance at one shading point, without
// shadows. F is float, double or lanes; T, the type of the light's own numbers, is float or double.
//
//   form factor = 1/pi * integral over the polygon's directions w above the horizon n.w > 0 of
//     lambert_form_factor:  n.w dw                                (irradiance = pi * radiance * it)
//     ltc_form_factor:      a linearly transformed cosine's pi * density, dw
//
// in [0, 1]. Lambert's formula: the integral of a clamped cosine over a polygon is 1/2 sum of
// theta_i n.(v_i x v_{i+1}) / |v_i x v_{i+1}| over its edges (Arvo, "Applications of Irradiance
// Tensors to the Simulation of Non-Lambertian Phenomena", 1995, eq. 5). A linear map K that takes a
// distribution to the clamped cosine takes the polygon along with it (Heitz, Dupuy, Hill, Neubelt,
// "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines", 2016, sec. 3).
// Differs: the polygon is clipped to the true horizon before it is transformed (most of the error
// of lights that peek over it), and the edges of lambert_form_factor are never formed from rounded
// directions; those of ltc_form_factor are (core/light/cosine_polygon.h).
//
// Accuracy in float, against the exact value for the given float vertices (measured and pinned by
// tests/core/light_polygon_test.cpp over lights of 1e-5 rad to the hemisphere, `size` the angular
// diameter): the edge sum errs by at most 8e-8 size (1 + farthest vertex / distance of the light's
// plane), absolutely; relatively that is about 1.3e-7 / size, more for lights seen edge-on: 8e-5
// was seen where the farthest vertex is 2000 such distances away. So lights whose root mean square
// radius, as seen from the point and in the lobe's own space, is below kSmallLight are integrated
// by rules on their area instead: relative error 1e-6 typically, continuous with the edge sum to
// 1e-5 where the two meet.

namespace penumbra {

// Radians. Where the two errors are equal, each about 2e-6. In double the edge sum serves longer.
template <class T>
inline constexpr T kSmallLight = std::is_same_v<T, double> ? T(1e-6) : T(0.018);
// The same for lights cut by a horizon, whose rule has more points and whose visible part is often
// much smaller than the light.
template <class T>
inline constexpr T kSmallCutLight = std::is_same_v<T, double> ? T(1e-6) : T(0.1);

namespace detail {

// 2 * the signed integral of the lobe's cosine over the whole polygon. Only the weights of the
// edges depend on the transform: sum w_i (v_i x v_{i+1}) with v_i = v_0 + offset_i is
// v_0 x sum w_i edge_i + sum w_i moment_i.
template <class F, class T, class Lobe>
F edge_sum(const PolygonShape<T>& light, const SeenPolygon<F>& seen, const Lobe& lobe,
           const Vec3<F>* directions) {
    F weights[kMaxClippedVertices];
    edge_weights(directions, light.count, weights);
    Vec3<F> edges{F(0), F(0), F(0)};
    Vec3<F> moments{F(0), F(0), F(0)};
    for (int i = 0; i < light.count; ++i) {
        edges = fma(in_lanes<F>(light.edges[i]), weights[i], edges);
        moments = fma(in_lanes<F>(light.moments[i]), weights[i], moments);
    }
    const Vec3<F> flux = lobe.flux();
    return dot(edges, cross(flux, seen.vertices[0])) + dot(flux, moments);
}

// Four points with the polygon's moments up to the second: for uncut polygons that look small.
template <class F, class T, class Lobe>
F small_form_factor(const PolygonShape<T>& light, const SeenPolygon<F>& seen, const Lobe& lobe) {
    const Vec3<F> center = lobe.direction(seen.center);
    const Vec3<F> first = lobe.direction(in_lanes<F>(light.spread[0]));
    const Vec3<F> second = lobe.direction(in_lanes<F>(light.spread[1]));
    const F sum = (point_kernel(lobe, center + first) + point_kernel(lobe, center - first)) +
                  (point_kernel(lobe, center + second) + point_kernel(lobe, center - second));
    return sum * (seen.distance * lobe.determinant()) *
           F(static_cast<T>(0.25 * 0.318309886183790672) * light.area);
}

// The mean squared radius in the lobe's space and the squared distance: their ratio is the squared
// angular radius, roughly.
template <class F>
struct AngularSize {
    F squared_radius, squared_distance;
    [[nodiscard]] simd::MaskOf<F> is_below(F angle) const {
        return squared_radius < angle * angle * squared_distance;
    }
};

template <class F, class T, class Lobe>
AngularSize<F> angular_size(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                            const Lobe& lobe) {
    F squared_spread = F(light.squared_spread);
    if constexpr (Lobe::kTransforms)
        squared_spread = F(0.5f) * (length_squared(lobe.direction(in_lanes<F>(light.spread[0]))) +
                                    length_squared(lobe.direction(in_lanes<F>(light.spread[1]))));
    return {squared_spread, length_squared(lobe.direction(seen.center))};
}

template <class F, class T, class Lobe>
F form_factor(const PolygonShape<T>& light, const SeenPolygon<F>& seen, const Lobe& lobe,
              ClippedPolygon<F>& above) {
    const auto& lit = seen.lit;
    const auto& cut = seen.crosses_horizon;
    if (!simd::any(lit)) return F(0);
    Vec3<F> directions[kMaxPolygonVertices];
    for (int i = 0; i < light.count; ++i) directions[i] = lobe.direction(seen.vertices[i]);
    const AngularSize<F> size = angular_size(light, seen, lobe);
    const auto small = size.is_below(F(kSmallLight<T>));
    F result = F(0);
    if (simd::any(lit & !(cut | small)))
        result = edge_sum(light, seen, lobe, directions) *
                 (seen.winding * F(T(0.5 * 0.318309886183790672)));
    if (simd::any(lit & small & (!cut)))
        result = simd::select(small, small_form_factor(light, seen, lobe), result);
    if (simd::any(lit & cut)) {
        const auto small_cut = size.is_below(F(kSmallCutLight<T>));
        const F part =
            cut_form_factor(light, seen, lobe, small_cut, horizon_part(light, seen, above));
        result = simd::select(cut, part, result);
    }
    return simd::select(lit, simd::saturate(result), F(0));
}

}  // namespace detail

template <class F, class T>
F lambert_form_factor(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                      const Vec3<F>& normal) {
    ClippedPolygon<F> above;
    return detail::form_factor(light, seen, CosineLobe<F>{normal}, above);
}

namespace detail {

// Of what the transformed lobe sees of the light.
template <class F, class T>
F cosine_space_form_factor(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                           const TransformedLobe<F>& lobe, const ClippedPolygon<F>& above,
                           const CosinePolygon<F>& polygon) {
    const auto& lit = seen.lit;
    const auto& cut = seen.crosses_horizon;
    const AngularSize<F> size = angular_size(light, seen, lobe);
    const auto small = (!cut) & size.is_below(F(kSmallLight<T>));
    const auto small_cut = cut & size.is_below(F(kSmallCutLight<T>));
    F result = polygon.irradiance.z * F(T(0.5 * 0.318309886183790672));
    if (simd::any(lit & small))
        result = simd::select(small, small_form_factor(light, seen, lobe), result);
    if (simd::any(lit & small_cut))
        result =
            simd::select(small_cut, clipped_small_form_factor(light, above, seen, lobe), result);
    return simd::select(lit, simd::saturate(result), F(0));
}

}  // namespace detail

// Both for the price of one clip, and what is left of the light, as the transformed lobe sees it.
template <class F>
struct FormFactors {
    F lambert, ltc;
};
template <class F, class T>
FormFactors<F> form_factors(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                            const Vec3<F>& normal, const TransformedLobe<F>& lobe,
                            CosinePolygon<F>& polygon) {
    ClippedPolygon<F> above;
    const F lambert = detail::form_factor(light, seen, CosineLobe<F>{normal}, above);
    make_cosine_polygon(light, seen, lobe, above, polygon);
    return {lambert, detail::cosine_space_form_factor(light, seen, lobe, above, polygon)};
}

template <class F, class T>
F ltc_form_factor(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                  const TransformedLobe<F>& lobe) {
    ClippedPolygon<F> above;
    if (simd::any(seen.lit & seen.crosses_horizon)) detail::horizon_part(light, seen, above);
    CosinePolygon<F> polygon;
    make_cosine_polygon(light, seen, lobe, above, polygon);
    return detail::cosine_space_form_factor(light, seen, lobe, above, polygon);
}

}  // namespace penumbra
