#pragma once

#include "core/light/polygon_shape.h"
#include "core/math/elementary.h"

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
// Differs: the polygon is clipped to the true horizon before it is transformed (FACTS: most of the
// error of lights that peek over it), and edges are never formed from rounded directions.
//
// Accuracy in float, against the exact value for the given float vertices (measured and pinned by
// tests/core/light_polygon_test.cpp over lights of 1e-5 rad to the hemisphere, `size` the angular
// diameter): the edge sum errs by at most 6e-8 size, absolutely; relatively that is about
// 1.3e-7 / size, more for lights seen edge-on. So lights whose root mean square radius, as seen
// from the point and in the lobe's own space, is below kSmallLight are integrated by rules on their
// area instead: relative error 1e-6 typically, continuous with the edge sum to 1e-5 where the two
// meet.

namespace penumbra {

// Radians. Where the two errors are equal, each about 2e-6. In double the edge sum serves longer.
template <class T>
inline constexpr T kSmallLight = std::is_same_v<T, double> ? T(1e-6) : T(0.018);
// The same for lights cut by a horizon, whose rule has more points and whose visible part is often
// much smaller than the light.
template <class T>
inline constexpr T kSmallCutLight = std::is_same_v<T, double> ? T(1e-6) : T(0.1);

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
// frame). Any scale; the determinant must be positive.
template <class F>
struct TransformedLobe {
    static constexpr bool kTransforms = true;
    Vec3<F> row_x, row_y, row_z;
    F map_determinant;
    [[nodiscard]] Vec3<F> direction(const Vec3<F>& v) const {
        return {dot(row_x, v), dot(row_y, v), dot(row_z, v)};
    }
    [[nodiscard]] F height(const Vec3<F>& direction_) const { return direction_.z; }
    // (K a x K b).z = flux . (a x b).
    [[nodiscard]] Vec3<F> flux() const { return cross(row_x, row_y); }
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

// theta / sin(theta) of cosines in [0, 1]: 1.2e-8 relative for the polynomial, a minimax fit of our
// own in 1 - cos; no arc cosine, hence no cancellation near 1.
template <class F>
F arc_over_sine(F cosine) {
    const F x = F(1) - cosine;
    if constexpr (std::is_same_v<F, double>) {
        const double sine = simd::sqrt(simd::max(x * (1 + cosine), 0.0));
        return x < 1e-4 ? 1 + x * (1.0 / 3 + x * (2.0 / 15 + x * (2.0 / 35)))
                        : atan2(sine, cosine) / sine;
    } else {
        F sum = F(0.011357376936579367f);
        for (const float coefficient :
             {-0.033457437314962486f, 0.05257877268953691f, -0.03515096183302246f,
              0.030985712751230268f, 0.019848678530043257f, 0.058037706546425386f,
              0.13326088350660623f, 0.3333355884198665f, 0.9999999885027411f})
            sum = simd::fma(sum, x, F(coefficient));
        return sum;
    }
}

template <class F>
F inverse_length(const Vec3<F>& v) {
    return F(1) / simd::sqrt(simd::max(length_squared(v), F(1e-36f)));
}

// Of the edges from a to b: pi - theta has the same sine as theta. That sine is what the edge's
// normal is divided by, so it comes from the cross product and not from the cosine.
template <class F>
F obtuse_arc_over_sine(F supplement, const Vec3<F>& a, const Vec3<F>& b, F inverse_lengths) {
    const F sine = simd::max(length(cross(a, b - a)) * inverse_lengths, F(1e-9f));
    return F(3.14159265358979323846) / sine - supplement;
}

// theta / |a x b| for the angle theta between each direction a and the next one, b.
template <class F>
void edge_weights(const Vec3<F>* directions, int count, F* weights) {
    F inverses[kMaxClippedVertices];  // first of each length, then of each pair's
    F cosines[kMaxClippedVertices];
    for (int i = 0; i < count; ++i) inverses[i] = inverse_length(directions[i]);
    const F first_inverse = inverses[0];
    F least = F(1);
    for (int i = 0; i < count; ++i) {
        const bool closes = i + 1 == count;
        inverses[i] = inverses[i] * (closes ? first_inverse : inverses[i + 1]);
        cosines[i] = dot(directions[i], directions[closes ? 0 : i + 1]) * inverses[i];
        weights[i] = arc_over_sine(simd::abs(cosines[i]));
        least = simd::min(cosines[i], least);
    }
    if (simd::any(least < F(0))) {
        for (int i = 0; i < count; ++i)
            weights[i] = simd::select(
                cosines[i] < F(0),
                obtuse_arc_over_sine(weights[i], directions[i],
                                     directions[i + 1 == count ? 0 : i + 1], inverses[i]),
                weights[i]);
    }
    for (int i = 0; i < count; ++i) weights[i] = weights[i] * inverses[i];
}

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

// The integrand of a small light at one of its points, per area and distance from its plane.
template <class F, class Lobe>
F point_kernel(const Lobe& lobe, const Vec3<F>& direction) {
    const F squared = simd::max(length_squared(direction), F(1e-18f));
    return simd::max(lobe.height(direction), F(0)) / (squared * squared);
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

// ---- polygons that a horizon cuts --------------------------------------------------------------

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

// Dunavant, "High Degree Efficient Symmetrical Gaussian Quadrature Rules for the Triangle" (1985):
// 6 points, degree 4, on each triangle of the fan.
template <class F, class T, class Lobe>
F clipped_small_form_factor(const PolygonShape<T>& light, const ClippedPolygon<F>& part,
                            const SeenPolygon<F>& seen, const Lobe& lobe) {
    constexpr T kPlace[2] = {T(0.445948490915965), T(0.091576213509771)};
    constexpr T kWeight[2] = {T(0.223381589678011), T(0.109951743655322)};
    const Vec3<F> normal = in_lanes<F>(light.normal);
    F total = F(0);
    for (int i = 1; i + 1 < part.count; ++i) {
        const Vec3<F> a = part.vertices[0];
        const Vec3<F> b = part.vertices[i] - a;
        const Vec3<F> c = part.vertices[i + 1] - a;
        F mean = F(0);
        for (int ring = 0; ring < 2; ++ring) {
            const F place = F(kPlace[ring]);
            const F rest = F(T(1) - T(2) * kPlace[ring]);
            const Vec3<F> origin = seen.vertices[0] + a;
            const F sum = point_kernel(lobe, lobe.direction(origin + (b + c) * place)) +
                          point_kernel(lobe, lobe.direction(origin + fma(b, rest, c * place))) +
                          point_kernel(lobe, lobe.direction(origin + fma(c, rest, b * place)));
            mean = simd::fma(sum, F(kWeight[ring]), mean);
        }
        total = simd::fma(mean, simd::max(dot(normal, cross(b, c - b)), F(0)), total);
    }
    return total * (seen.distance * lobe.determinant()) * F(T(0.5 * 0.318309886183790672));
}

template <class F, class T, class Lobe>
F part_form_factor(const PolygonShape<T>& light, const SeenPolygon<F>& seen, const Lobe& lobe,
                   const simd::MaskOf<F>& small, const ClippedPolygon<F>& part) {
    const F result = clipped_edge_sum(part, seen.vertices[0], lobe) *
                     (seen.winding * F(T(0.5 * 0.318309886183790672)));
    if (simd::none(small)) return result;
    return simd::select(small, clipped_small_form_factor(light, part, seen, lobe), result);
}

// Of a cosine's part above the horizon, which is its own.
template <class F, class T>
F cut_form_factor(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                  const CosineLobe<F>& lobe, const simd::MaskOf<F>& small,
                  const ClippedPolygon<F>& above) {
    return simd::select(above.visible, part_form_factor(light, seen, lobe, small, above), F(0));
}

// Of what lies above the lobe's own horizon too.
template <class F, class T>
F cut_form_factor(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                  const TransformedLobe<F>& lobe, const simd::MaskOf<F>& small,
                  const ClippedPolygon<F>& above) {
    F heights[kMaxClippedVertices];
    F highest = F(0);
    F lowest = F(0);
    for (int i = 0; i < above.count; ++i) {
        heights[i] = lobe.height(lobe.direction(seen.vertices[0] + above.vertices[i]));
        highest = simd::max(heights[i], highest);
        lowest = simd::min(heights[i], lowest);
    }
    const auto visible = above.visible & (highest > F(0));
    // Cutting nothing off would only repeat a vertex, and an edge without length adds nothing.
    if (simd::none(visible & (lowest < F(0))))
        return simd::select(visible, part_form_factor(light, seen, lobe, small, above), F(0));
    ClippedPolygon<F> part;
    clip_by_heights(above.vertices, heights, above.count, part);
    return simd::select(visible, part_form_factor(light, seen, lobe, small, part), F(0));
}

template <class F, class T, class Lobe>
F form_factor(const PolygonShape<T>& light, const SeenPolygon<F>& seen, const Lobe& lobe,
              ClippedPolygon<F>& above) {
    auto lit = seen.lit;
    auto cut = seen.crosses_horizon;
    Vec3<F> directions[kMaxPolygonVertices];
    if constexpr (Lobe::kTransforms) {
        auto peeks_out = lit & (!lit);
        for (int i = 0; i < light.count; ++i) {
            directions[i] = lobe.direction(seen.vertices[i]);
            const auto below = lobe.height(directions[i]) < F(0);
            peeks_out = peeks_out | (!below);
            cut = cut | below;
        }
        lit = lit & peeks_out;
    } else {
        for (int i = 0; i < light.count; ++i) directions[i] = seen.vertices[i];
    }
    if (!simd::any(lit)) return F(0);
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

template <class F, class T>
F lambert_form_factor(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                      const Vec3<F>& normal) {
    ClippedPolygon<F> above;
    return detail::form_factor(light, seen, CosineLobe<F>{normal}, above);
}

template <class F, class T>
F ltc_form_factor(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                  const TransformedLobe<F>& lobe) {
    ClippedPolygon<F> above;
    return detail::form_factor(light, seen, lobe, above);
}

// Both for the price of one clip.
template <class F>
struct FormFactors {
    F lambert, ltc;
};
template <class F, class T>
FormFactors<F> form_factors(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                            const Vec3<F>& normal, const TransformedLobe<F>& lobe) {
    ClippedPolygon<F> above;
    const F lambert = detail::form_factor(light, seen, CosineLobe<F>{normal}, above);
    return {lambert, detail::form_factor(light, seen, lobe, above)};
}

}  // namespace penumbra
