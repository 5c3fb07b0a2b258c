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
// to 1e-8 rad). Lights wider than 300 times the point's distance from their plane are sampled a
// little unevenly (the mean direction errs by 1e-3 there, 1e-2 at 1000): the apex lies near the
// horizon.

namespace penumbra {

// A light's part above the horizon, as seen from one point, ready to be sampled: a fan of triangles
// around an apex. Triangle i ends in vertex i + 1 of the light and begins in vertex i, or where the
// outline comes up over the horizon. Places are relative to the light's first vertex.
template <class F>
struct PolygonSampler {
    struct Corner {
        Vec3<F> place;
        F inverse_distance;  // from the point
    };
    Corner apex, entry;
    F inverse_distances[kMaxPolygonVertices];  // of the light's vertices
    F determinants[kMaxPolygonVertices];       // of the unit vectors to a triangle's corners
    F half_angles[kMaxPolygonVertices];        // half its solid angle; 0 where there is none
    F solid_angle;                             // of all triangles; 0 where nothing is visible
};

template <class F, class T>
PolygonSampler<F> make_polygon_sampler(const PolygonShape<T>& light, const SeenPolygon<F>& seen);

// From [0, 1)^2 to a place on the light, relative to its first vertex. The density over directions
// is 1 / sampler.solid_angle, which must not be 0.
template <class F, class T>
Vec3<F> sample_polygon(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                       const PolygonSampler<F>& sampler, const Vec2<F>& random);

// The same in two steps, for loops that take several points through each: the place on a triangle's
// side opposite the apex, then the place between the two.
template <class F, class T>
Vec3<F> choose_opposite(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                        const PolygonSampler<F>& sampler, F random);
template <class F>
Vec3<F> choose_between(const SeenPolygon<F>& seen, const PolygonSampler<F>& sampler,
                       const Vec3<F>& opposite, F random);

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

// A corner of a triangle and the unit vector to it.
template <class F>
struct SeenCorner {
    Vec3<F> place;
    F inverse_distance;
    Vec3<F> direction;
};

template <class F>
SeenCorner<F> see_corner(const SeenPolygon<F>& seen, const Vec3<F>& place, F inverse_distance) {
    return {place, inverse_distance, (seen.vertices[0] + place) * inverse_distance};
}

template <class F>
SeenCorner<F> see_corner(const SeenPolygon<F>& seen, const Vec3<F>& place) {
    return see_corner(seen, place, detail::inverse_length(seen.vertices[0] + place));
}

template <class F>
SeenCorner<F> select_corner(const simd::MaskOf<F>& mask, const SeenCorner<F>& a,
                            const SeenCorner<F>& b) {
    return {select(mask, a.place, b.place),
            simd::select(mask, a.inverse_distance, b.inverse_distance),
            select(mask, a.direction, b.direction)};
}

// Of the unit vectors to the corners: twice the triangle's area times the plane's distance, over
// the corners' distances. Nothing cancels.
template <class F, class T>
F unit_determinant(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                   const SeenCorner<F>& apex, const SeenCorner<F>& start,
                   const SeenCorner<F>& end) {
    const Vec3<F> normal = detail::in_lanes<F>(light.normal);
    const F doubled_area = dot(normal, cross(start.place - apex.place, end.place - apex.place));
    const F nearness = start.inverse_distance * end.inverse_distance;
    return simd::max(doubled_area, F(0)) * (seen.distance * apex.inverse_distance) * nearness;
}

// Van Oosterom and Strackee, "The Solid Angle of a Plane Triangle" (1983).
template <class F>
F half_solid_angle(F determinant, const SeenCorner<F>& apex, const SeenCorner<F>& start,
                   const SeenCorner<F>& end) {
    return atan2(determinant, F(1) + dot(apex.direction, start.direction) +
                                  dot(start.direction, end.direction) +
                                  dot(end.direction, apex.direction));
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

// One triangle of the fan and how much of it, as half a solid angle, lies before the sample.
template <class F>
struct ChosenTriangle {
    SeenCorner<F> start, end;
    F determinant, half_angle_before;
};

template <class F, class T>
ChosenTriangle<F> choose_triangle(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                                  const PolygonSampler<F>& sampler, F random) {
    const F wanted = random * (F(0.5f) * sampler.solid_angle);
    F begin = F(0), chosen_begin = F(0), chosen_half = F(0), determinant = F(0);
    Vec3<F> start_place = sampler.apex.place, end_place = sampler.apex.place;
    F start_inverse = sampler.apex.inverse_distance, end_inverse = sampler.apex.inverse_distance;
    for (int i = 0; i < light.count; ++i) {
        const int next = i + 1 < light.count ? i + 1 : 0;
        const F half = sampler.half_angles[i];
        // The last one that begins before the wanted share: never an empty one.
        const auto chosen = (half > F(0)) & (begin <= wanted);
        const auto below = seen.heights[i] < F(0);
        start_place = select(
            chosen, select(below, sampler.entry.place, detail::in_lanes<F>(light.offsets[i])),
            start_place);
        start_inverse = simd::select(
            chosen,
            simd::select(below, sampler.entry.inverse_distance, sampler.inverse_distances[i]),
            start_inverse);
        end_place = select(chosen, detail::in_lanes<F>(light.offsets[next]), end_place);
        end_inverse = simd::select(chosen, sampler.inverse_distances[next], end_inverse);
        determinant = simd::select(chosen, sampler.determinants[i], determinant);
        chosen_begin = simd::select(chosen, begin, chosen_begin);
        chosen_half = simd::select(chosen, half, chosen_half);
        begin += half;
    }
    return {see_corner(seen, start_place, start_inverse), see_corner(seen, end_place, end_inverse),
            determinant, simd::min(wanted - chosen_begin, chosen_half)};
}

// The fraction of the way from the triangle's start to its end at which the sub-triangle ends that
// holds the solid angle before the sample. The direction there is that of the start, reflected
// about o = from_start * start + from_end * end.
template <class F>
F sub_triangle_place(const ChosenTriangle<F>& triangle, const SeenCorner<F>& apex) {
    const SeenCorner<F>& start = triangle.start;
    const SeenCorner<F>& end = triangle.end;
    F sine, cosine;
    sincos(triangle.half_angle_before, sine, cosine);
    // Only the ratio of the two factors counts: scaled so that their squares do not underflow for
    // lights of 1e-12 sr.
    const F share = sine * F(0x1p32f);
    const F start_end = dot(start.direction, end.direction);
    const F from_end = (F(1) + dot(apex.direction, start.direction)) * share;
    const F from_start = simd::fma(triangle.determinant * F(0x1p32f), cosine,
                                   -((start_end + dot(apex.direction, end.direction)) * share));
    const F along_start = simd::fma(from_end, start_end, from_start);
    const F along_end = simd::fma(from_start, start_end, from_end);
    const F twice = along_start + along_start;
    const F squared = simd::fma(from_start, along_start, from_end * along_end);
    // Weights of the unit vectors times |o|^2, then of the places.
    const F start_weight =
        simd::max(simd::fma(twice, from_start, -squared), F(0)) * start.inverse_distance;
    const F end_weight = simd::max(twice * from_end, F(0)) * end.inverse_distance;
    return end_weight / simd::max(start_weight + end_weight, F(1e-36f));
}

// The fraction of the way from the apex to `opposite` of the direction whose 1 - cosine is `random`
// times that of the whole arc: the weights of the two unit vectors are z - c s and s with z = 1 -
// part, c = 1 - whole and s = sqrt((1 - z^2) / (1 - c^2)), here times 2 - whole.
template <class F>
F arc_place(const SeenCorner<F>& apex, const SeenCorner<F>& opposite, F random) {
    const Vec3<F> chord = opposite.direction - apex.direction;
    const F whole = simd::min(F(0.5f) * length_squared(chord), F(1.9999998f));
    const F part = random * whole;
    const F rest = F(2) - whole;
    const F far_unit = simd::sqrt(random * (F(2) - part) * rest);
    const F apex_unit = simd::max(simd::fma(F(1) - part, rest, -(far_unit * (F(1) - whole))), F(0));
    const F far_weight = far_unit * opposite.inverse_distance;
    return far_weight /
           simd::max(simd::fma(apex_unit, apex.inverse_distance, far_weight), F(1e-36f));
}

}  // namespace sampling_detail

template <class F, class T>
PolygonSampler<F> make_polygon_sampler(const PolygonShape<T>& light, const SeenPolygon<F>& seen) {
    using namespace sampling_detail;
    PolygonSampler<F> sampler;
    const auto cut = seen.crosses_horizon;
    const bool any_cut = simd::any(cut);
    SeenCorner<F> corner = see_corner(seen, detail::in_lanes<F>(light.offsets[0]));
    SeenCorner<F> apex = corner, entry = corner;
    sampler.inverse_distances[0] = corner.inverse_distance;
    if (any_cut) {
        const HorizonPlaces<F> places = horizon_places(light, seen);
        apex = select_corner(cut, see_corner(seen, places.exit), corner);
        entry = see_corner(seen, places.entry);
    }
    sampler.apex = {apex.place, apex.inverse_distance};
    sampler.entry = {entry.place, entry.inverse_distance};
    F total = F(0);
    for (int i = 0; i < light.count; ++i) {
        const int next = i + 1 < light.count ? i + 1 : 0;
        const SeenCorner<F> end = see_corner(seen, detail::in_lanes<F>(light.offsets[next]));
        // An uncut fan has its apex at vertex 0: the two edges there span no triangle.
        const bool touches_apex = i == 0 || next == 0;
        const auto spans =
            seen.lit & !(seen.heights[next] < F(0)) & (cut | simd::MaskOf<F>(!touches_apex));
        F determinant = F(0), half = F(0);
        if (simd::any(spans)) {
            const auto below = seen.heights[i] < F(0);
            const SeenCorner<F> start = any_cut ? select_corner(below, entry, corner) : corner;
            determinant = unit_determinant(light, seen, apex, start, end);
            half = simd::select(spans, half_solid_angle(determinant, apex, start, end), F(0));
        }
        sampler.inverse_distances[next] = end.inverse_distance;
        sampler.determinants[i] = determinant;
        sampler.half_angles[i] = half;
        total += half;
        corner = end;
    }
    sampler.solid_angle = F(2) * total;
    return sampler;
}

template <class F, class T>
Vec3<F> choose_opposite(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                        const PolygonSampler<F>& sampler, F random) {
    using namespace sampling_detail;
    const ChosenTriangle<F> triangle = choose_triangle(light, seen, sampler, random);
    const SeenCorner<F> apex = see_corner(seen, sampler.apex.place, sampler.apex.inverse_distance);
    const F along = sub_triangle_place(triangle, apex);
    return fma(triangle.end.place - triangle.start.place, along, triangle.start.place);
}

template <class F>
Vec3<F> choose_between(const SeenPolygon<F>& seen, const PolygonSampler<F>& sampler,
                       const Vec3<F>& opposite, F random) {
    using namespace sampling_detail;
    const SeenCorner<F> apex = see_corner(seen, sampler.apex.place, sampler.apex.inverse_distance);
    const F outward = arc_place(apex, see_corner(seen, opposite), random);
    return fma(opposite - apex.place, outward, apex.place);
}

template <class F, class T>
Vec3<F> sample_polygon(const PolygonShape<T>& light, const SeenPolygon<F>& seen,
                       const PolygonSampler<F>& sampler, const Vec2<F>& random) {
    return choose_between(seen, sampler, choose_opposite(light, seen, sampler, random.x), random.y);
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
