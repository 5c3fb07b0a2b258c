#pragma once

#include "core/light/polygon.h"
#include "core/math/elementary.h"

// Uniform sampling of the solid angle of a convex polygon light, of the part above the horizon.
//
// The visible part is cut into a fan of spherical triangles; one is chosen by its solid angle, and
// a point in it after Arvo, "Stratified Sampling of Spherical Triangles" (1995), in the form
// without inverse trigonometry of Peters, "BRDF Importance Sampling for Polygonal Lights" (2021).
// Differs: nothing is formed from differences of unit vectors. Triangles, sub-triangles and the
// sample are kept as places in the light's own plane, relative to its first vertex, with spherical
// weights; so the sample always lies on the light, and lights of any size and distance are sampled
// evenly: neither the determinants nor the places lose digits where the light is small (tests: down
// to 1e-8 rad).

namespace penumbra {

// A light's part above the horizon, as seen from one point, ready to be sampled.
template <class F>
struct PolygonSampler {
    F half_angles[kMaxPolygonVertices];  // half the solid angle of the triangle that ends in vertex
                                         // i + 1: (apex, start of edge i, its end)
    Vec3<F> apex;                        // places: relative to the light's first vertex
    Vec3<F> entry;                       // where the outline comes up over the horizon, if it does
    F solid_angle;                       // of all triangles; 0 where nothing is visible
};

template <class F, class T>
PolygonSampler<F> make_polygon_sampler(const PolygonShape<T>& light, const SeenPolygon<F>& seen);

// From [0, 1)^2 to a place on the light, relative to its first vertex. The density over directions
// is 1 / sampler.solid_angle, which must not be 0.
template <class F, class T>
Vec3<F> sample_polygon(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                       const PolygonSampler<F>& sampler, const Vec2<F>& random);

// Where a direction from the point (unit, above the horizon) meets the light.
template <class F>
struct PolygonHit {
    Vec3<F> place;  // relative to the light's first vertex
    simd::MaskOf<F> hit;
};
template <class F, class T>
PolygonHit<F> intersect_polygon(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                                const Vec3<F>& direction);

// ---- implementation --------------------------------------------------------------------------

namespace sampling_detail {

// A corner of a triangle, as seen from the point.
template <class F>
struct Corner {
    Vec3<F> place;      // in the light's plane
    Vec3<F> direction;  // unit
    F inverse_distance;
};

template <class F>
Corner<F> make_corner(const SeenPolygon<F>& seen, const Vec3<F>& place) {
    const Vec3<F> vector = seen.vertices[0] + place;
    const F inverse = F(1) / simd::sqrt(simd::max(length_squared(vector), F(1e-36f)));
    return {place, vector * inverse, inverse};
}

template <class F>
struct SphericalTriangle {
    F determinant;  // of the unit vectors to the corners, >= 0
    F denominator;  // determinant / denominator is the tangent of half the solid angle
};

// Van Oosterom and Strackee, "The Solid Angle of a Plane Triangle" (1983). The determinant is twice
// the triangle's area times the plane's distance, over the corners' distances: no cancellation.
template <class F, class T>
SphericalTriangle<F> spherical_triangle(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                                        const Corner<F>& apex, const Corner<F>& start,
                                        const Corner<F>& end) {
    const Vec3<F> normal = detail::in_lanes<F>(light.normal);
    const F doubled_area = dot(normal, cross(start.place - apex.place, end.place - apex.place));
    const F scale = seen.distance * apex.inverse_distance;
    const F nearness = start.inverse_distance * end.inverse_distance;
    return {simd::max(doubled_area, F(0)) * scale * nearness,
            F(1) + dot(apex.direction, start.direction) + dot(start.direction, end.direction) +
                dot(end.direction, apex.direction)};
}

// Where the outline leaves the upper side of the horizon and where it comes back.
template <class F>
struct HorizonPlaces {
    Vec3<F> exit{F(0), F(0), F(0)}, entry{F(0), F(0), F(0)};
};

template <class F, class T>
HorizonPlaces<F> horizon_places(const PolygonShape<T>& light, const SeenPolygon<F>& seen) {
    HorizonPlaces<F> places;
    for (int i = 0; i < light.count; ++i) {
        const int next = i + 1 < light.count ? i + 1 : 0;
        const auto below = seen.heights[i] < F(0);
        const auto next_below = seen.heights[next] < F(0);
        const F span = seen.heights[i] - seen.heights[next];
        const auto crosses = below ^ next_below;
        const F t = seen.heights[i] / simd::select(crosses, span, F(1));
        const Vec3<F> place =
            fma(detail::in_lanes<F>(light.edges[i]), t, detail::in_lanes<F>(light.offsets[i]));
        places.exit = select(crosses & next_below, place, places.exit);
        places.entry = select(crosses & below, place, places.entry);
    }
    return places;
}

// The fraction of the way from `start` to `end` at which a sub-triangle of the fan ends that has
// the share `share` of the triangle's solid angle. The end's direction is that of `start`,
// reflected about o = from_start * start + from_end * end.
template <class F>
F sub_triangle_place(const SphericalTriangle<F>& triangle, const Corner<F>& apex,
                     const Corner<F>& start, const Corner<F>& end, F half_angle) {
    F sine, cosine;
    sincos(half_angle, sine, cosine);
    const F start_end = dot(start.direction, end.direction);
    const F scale = F(1) / simd::max(triangle.determinant + sine, F(1e-36f));
    const F share = sine * scale;
    const F across = dot(apex.direction, start.direction);
    const F from_end = (F(1) + across) * share;
    const F from_start = simd::fma(triangle.determinant * scale, cosine,
                                   -((start_end + dot(apex.direction, end.direction)) * share));
    const F along_start = simd::fma(from_end, start_end, from_start);
    const F along_end = simd::fma(from_start, start_end, from_end);
    const F squared =
        simd::max(simd::fma(from_start, along_start, from_end * along_end), F(1e-36f));
    const F twice = F(2) * along_start / squared;
    // Weights of the unit vectors, then of the places.
    const F start_weight =
        simd::max(simd::fma(twice, from_start, F(-1)), F(0)) * start.inverse_distance;
    const F end_weight = simd::max(twice * from_end, F(0)) * end.inverse_distance;
    return end_weight / simd::max(start_weight + end_weight, F(1e-36f));
}

// The fraction of the way from the apex to `opposite` of the direction whose 1 - cosine is `random`
// times that of the whole arc.
template <class F>
F arc_place(const Corner<F>& apex, const Corner<F>& opposite, F random) {
    const Vec3<F> chord = opposite.direction - apex.direction;
    const F whole = simd::min(F(0.5f) * length_squared(chord), F(1.9999998f));
    const F part = random * whole;
    // sqrt((1 - z^2) / (1 - c^2)) with z = 1 - part and c = 1 - whole.
    const F ratio = simd::sqrt(random * (F(2) - part) / (F(2) - whole));
    const F apex_weight = simd::max((F(1) - part) - ratio * (F(1) - whole), F(0));
    const F far_weight = ratio * opposite.inverse_distance;
    return far_weight /
           simd::max(simd::fma(apex_weight, apex.inverse_distance, far_weight), F(1e-36f));
}

}  // namespace sampling_detail

template <class F, class T>
PolygonSampler<F> make_polygon_sampler(const PolygonShape<T>& light, const SeenPolygon<F>& seen) {
    using namespace sampling_detail;
    PolygonSampler<F> sampler;
    sampler.apex = sampler.entry = {F(0), F(0), F(0)};
    const auto cut = seen.crosses_horizon;
    if (simd::any(cut)) {
        const HorizonPlaces<F> places = horizon_places(light, seen);
        sampler.apex = select(cut, places.exit, sampler.apex);
        sampler.entry = places.entry;
    }
    const Corner<F> apex = make_corner(seen, sampler.apex);
    const Corner<F> entry = make_corner(seen, sampler.entry);
    Corner<F> corner = make_corner(seen, detail::in_lanes<F>(light.offsets[0]));
    F total = F(0);
    for (int i = 0; i < light.count; ++i) {
        const int next = i + 1 < light.count ? i + 1 : 0;
        const Corner<F> end = make_corner(seen, detail::in_lanes<F>(light.offsets[next]));
        const auto below = seen.heights[i] < F(0);
        const Corner<F> start = {
            select(below, entry.place, corner.place),
            select(below, entry.direction, corner.direction),
            simd::select(below, entry.inverse_distance, corner.inverse_distance)};
        const auto triangle = spherical_triangle(light, seen, apex, start, end);
        const F half = atan2(triangle.determinant, triangle.denominator);
        // An uncut fan has its apex at vertex 0: the two edges there span no triangle.
        const bool touches_apex = i == 0 || next == 0;
        const auto spans =
            seen.lit & !(seen.heights[next] < F(0)) & (cut | simd::MaskOf<F>(!touches_apex));
        sampler.half_angles[i] = simd::select(spans, half, F(0));
        total += sampler.half_angles[i];
        corner = end;
    }
    sampler.solid_angle = F(2) * total;
    return sampler;
}

template <class F, class T>
Vec3<F> sample_polygon(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                       const PolygonSampler<F>& sampler, const Vec2<F>& random) {
    using namespace sampling_detail;
    // The last triangle that begins before the wanted share of the solid angle: never an empty one.
    const F wanted = random.x * (F(0.5f) * sampler.solid_angle);
    F begin = F(0), chosen_begin = F(0), chosen_half = F(0);
    Vec3<F> start_place = sampler.apex, end_place = sampler.apex;
    for (int i = 0; i < light.count; ++i) {
        const int next = i + 1 < light.count ? i + 1 : 0;
        const F half = sampler.half_angles[i];
        const auto chosen = (half > F(0)) & (begin <= wanted);
        const Vec3<F> start =
            select(seen.heights[i] < F(0), sampler.entry, detail::in_lanes<F>(light.offsets[i]));
        start_place = select(chosen, start, start_place);
        end_place = select(chosen, detail::in_lanes<F>(light.offsets[next]), end_place);
        chosen_begin = simd::select(chosen, begin, chosen_begin);
        chosen_half = simd::select(chosen, half, chosen_half);
        begin += half;
    }
    const Corner<F> apex = make_corner(seen, sampler.apex);
    const Corner<F> start = make_corner(seen, start_place);
    const Corner<F> end = make_corner(seen, end_place);
    const auto triangle = spherical_triangle(light, seen, apex, start, end);
    const F half = simd::min(wanted - chosen_begin, chosen_half);
    const F along = sub_triangle_place(triangle, apex, start, end, half);
    const Corner<F> opposite = make_corner(seen, fma(end_place - start_place, along, start_place));
    const F outward = arc_place(apex, opposite, random.y);
    return fma(opposite.place - apex.place, outward, apex.place);
}

template <class F, class T>
PolygonHit<F> intersect_polygon(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                                const Vec3<F>& direction) {
    const Vec3<F> normal = detail::in_lanes<F>(light.normal);
    const F towards = seen.winding * dot(normal, direction);
    PolygonHit<F> result;
    result.hit = seen.lit & (towards > F(0));
    const F distance = seen.distance / simd::select(result.hit, towards, F(1));
    const Vec3<F> place = direction * distance - seen.vertices[0];
    result.place = place - normal * dot(normal, place);
    for (int i = 0; i < light.count; ++i) {
        const Vec3<F> from_vertex = result.place - detail::in_lanes<F>(light.offsets[i]);
        const Vec3<F> edge = detail::in_lanes<F>(light.edges[i]);
        result.hit &= dot(normal, cross(edge, from_vertex)) >= F(0);
    }
    return result;
}

}  // namespace penumbra
