#pragma once

#include "core/math/vec.h"
#include "shadow/exact_sum.h"

// Does a segment meet a triangle? Answered as if in real numbers, so that no processor, instruction
// set, order of the vertices or neighbouring triangle can change the answer.
//
// For a segment origin + t * direction, near <= t <= far, and a triangle's vertices A, B, C
// relative to the origin, let
//     volumes  D.(B x C), D.(C x A), D.(A x B);   facing = their sum;   plane = A.(B x C).
// The line meets the closed triangle where no two volumes have opposite signs and facing is not 0,
// at t = plane / facing. A triangle that is seen edge-on (facing = 0) is not met: its neighbours
// are. A segment that leaves a closed mesh meets it: where it does, the surface cannot be made of
// planes alone that contain the segment, and both triangles of an edge own it.
//
// A first look in float or double compares with bounds of its rounding errors and settles nearly
// all; what it leaves open is settled by exact sums.

namespace penumbra::shadow {

// What the first look found. Lanes in neither are open.
template <class F>
struct Verdict {
    simd::MaskOf<F> meets, misses;
};

template <class F>
struct Rounding {
    static constexpr float kUnit = 0x1p-24f;         // half the distance from 1 to the next number
    static constexpr float kCoordinate = 0x1p-100f;  // far above what flushed denormals lose
    static constexpr float kProduct = 0x1p-120f;
};
template <>
struct Rounding<double> {
    static constexpr double kUnit = 0x1p-53;
    static constexpr double kCoordinate = 0x1p-900;
    static constexpr double kProduct = 0x1p-1000;
};

// A segment in a frame whose z axis is the largest component of its direction, sheared so that the
// direction becomes that axis: Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection"
// (2013). Coordinates are permuted, (x, y, z) being axes (axis + 1, axis + 2, axis) modulo 3.
template <class F>
struct ShearedSegment {
    Vec3<F> origin;      // permuted
    F shear_x, shear_y;  // direction.x / direction.z, direction.y / direction.z
    F low, high;         // the segment's ends along z, relative to the origin
};

// Half the widths of the intervals that contain the exact values, times a little.
template <class F>
struct ErrorBounds {
    F z;       // of an unsheared coordinate
    F volume;  // of x * y - y * x
};

// With u = Rounding::kUnit, radius and depth the largest |x|, |y| and |z| of the vertices after and
// before the shear: P - O errs by u times itself, the shear by 2u, the fused multiply-add by u, so
// a sheared coordinate errs by at most u (2 radius + 3 depth) and terms of u^2; a volume by 4 u
// radius^2 for its own three roundings and 4 error radius + 2 error^2 for the coordinates', where
// u radius <= error / 3. Factors are rounded up by more than all the u^2.
template <class F>
ErrorBounds<F> error_bounds(F radius, F depth, F end) {
    using R = Rounding<F>;
    const F error =
        simd::fma(F(3 * R::kUnit), radius, simd::fma(F(4 * R::kUnit), depth, F(R::kCoordinate)));
    return {F(3 * R::kUnit) * (depth + end) + F(R::kCoordinate),
            simd::fma(error, simd::fma(F(6), radius, F(3) * error), F(R::kProduct))};
}

template <class F>
F smallest(F a, F b, F c) {
    return simd::min(simd::min(a, b), c);
}
template <class F>
F largest(F a, F b, F c) {
    return simd::max(simd::max(a, b), c);
}
template <class F>
F largest_magnitude(F a, F b, F c) {
    return largest(simd::abs(a), simd::abs(b), simd::abs(c));
}

template <class F>
struct ShearedTriangle {
    F x[3], y[3], z[3];  // of the vertices
    F volume[3];         // opposite of each; all of one sign where the z axis passes inside
};

template <class F>
ShearedTriangle<F> sheared(const ShearedSegment<F>& s, const Vec3<F> (&vertices)[3]) {
    ShearedTriangle<F> t;
    for (int i = 0; i < 3; ++i) {
        t.z[i] = vertices[i].z - s.origin.z;
        t.x[i] = simd::fma(-s.shear_x, t.z[i], vertices[i].x - s.origin.x);
        t.y[i] = simd::fma(-s.shear_y, t.z[i], vertices[i].y - s.origin.y);
    }
    for (int i = 0; i < 3; ++i) {
        const int b = (i + 1) % 3, c = (i + 2) % 3;
        t.volume[i] = t.x[b] * t.y[c] - t.y[b] * t.x[c];
    }
    return t;
}

// Is the point where the z axis meets the triangle certainly above (meets) or certainly below
// (misses) z = end? `sign` turns the volumes positive. The sum of volume * (z - end) errs by what
// the volumes and the differences do, and by 3 u for the product and the additions.
template <class F>
Verdict<F> above(const ShearedTriangle<F>& t, F end, F sign, const ErrorBounds<F>& bounds) {
    const F z0 = t.z[0] - end, z1 = t.z[1] - end, z2 = t.z[2] - end;
    const F height = sign * (t.volume[0] * z0 + t.volume[1] * z1 + t.volume[2] * z2);
    const F span = largest_magnitude(z0, z1, z2);
    const F volume = largest_magnitude(t.volume[0], t.volume[1], t.volume[2]);
    const F error = F(4) * (bounds.volume * (span + bounds.z) +
                            volume * (bounds.z + F(4 * Rounding<F>::kUnit) * span)) +
                    F(Rounding<F>::kProduct);
    return {height > error, height < -error};
}

template <class F>
Verdict<F> first_look(const ShearedSegment<F>& s, const Vec3<F> (&vertices)[3]) {
    const ShearedTriangle<F> t = sheared(s, vertices);
    const F radius = simd::max(largest_magnitude(t.x[0], t.x[1], t.x[2]),
                               largest_magnitude(t.y[0], t.y[1], t.y[2]));
    const F depth = largest_magnitude(t.z[0], t.z[1], t.z[2]);
    const ErrorBounds<F> low_bounds = error_bounds(radius, depth, simd::abs(s.low));
    const F volume_error = low_bounds.volume;
    const F lowest = smallest(t.volume[0], t.volume[1], t.volume[2]);
    const F highest = largest(t.volume[0], t.volume[1], t.volume[2]);
    Verdict<F> verdict;
    verdict.misses = (lowest < -volume_error) & (highest > volume_error);
    const auto inside = (lowest > volume_error) | (highest < -volume_error);
    verdict.meets = inside;
    if (simd::all(verdict.misses)) return verdict;

    // All of the triangle between the segment's ends, or all of it beyond one of them?
    const ErrorBounds<F> high_bounds = error_bounds(radius, depth, simd::abs(s.high));
    const F nearest = smallest(t.z[0], t.z[1], t.z[2]), farthest = largest(t.z[0], t.z[1], t.z[2]);
    verdict.misses =
        verdict.misses | (farthest < s.low - low_bounds.z) | (nearest > s.high + high_bounds.z);
    const auto within = (nearest > s.low + low_bounds.z) & (farthest < s.high - high_bounds.z);
    verdict.meets = inside & within;
    if (simd::none(inside & (!within) & (!verdict.misses))) return verdict;

    const F sign = simd::select(lowest > F(0), F(1), F(-1));
    const Verdict<F> above_low = above(t, s.low, sign, low_bounds);
    const Verdict<F> above_high = above(t, s.high, sign, high_bounds);
    verdict.meets = verdict.meets | (inside & above_low.meets & above_high.misses);
    verdict.misses = verdict.misses | (inside & (above_low.misses | above_high.meets));
    return verdict;
}

// ---- exactly -----------------------------------------------------------------------------------

struct Segment {
    Vec3f origin, direction;
    float near_limit, far_limit;
};

struct ExactVector {
    WithError component[3];
};

inline ExactVector exact_difference(const Vec3f& a, const Vec3f& b) {
    return {{exact_add(double{a.x}, -double{b.x}), exact_add(double{a.y}, -double{b.y}),
             exact_add(double{a.z}, -double{b.z})}};
}

inline void add_product(const WithError& a, const WithError& b, const WithError& c, double factor,
                        ExactSum& sum) {
    for (const double x : {a.value, a.error})
        for (const double y : {b.value, b.error})
            for (const double z : {c.value, c.error})
                if (x != 0 && y != 0 && z != 0) sum.add_product(x, y, z, factor);
}

// sum += factor * a.(b x c)
inline void add_determinant(const ExactVector& a, const ExactVector& b, const ExactVector& c,
                            double factor, ExactSum& sum) {
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        add_product(a.component[i], b.component[j], c.component[k], factor, sum);
        add_product(a.component[i], b.component[k], c.component[j], -factor, sum);
    }
}

inline bool meets_exactly(const Segment& segment, const Vec3f (&vertices)[3]) {
    const Vec3f& d = segment.direction;
    const ExactVector direction = {{{d.x, 0}, {d.y, 0}, {d.z, 0}}};
    const ExactVector v[3] = {exact_difference(vertices[0], segment.origin),
                              exact_difference(vertices[1], segment.origin),
                              exact_difference(vertices[2], segment.origin)};
    bool any_positive = false, any_negative = false;
    for (int i = 0; i < 3; ++i) {
        ExactSum volume;
        add_determinant(direction, v[(i + 1) % 3], v[(i + 2) % 3], 1, volume);
        any_positive |= volume.sign() > 0;
        any_negative |= volume.sign() < 0;
    }
    if (any_positive == any_negative) return false;  // passes beside, or sees the triangle edge-on
    // The sign of facing * (t - limit), where facing has the volumes' sign.
    const auto side_of = [&](float limit) {
        ExactSum sum;
        add_determinant(v[0], v[1], v[2], 1, sum);
        for (int i = 0; i < 3; ++i)
            add_determinant(direction, v[(i + 1) % 3], v[(i + 2) % 3], -double{limit}, sum);
        return any_positive ? sum.sign() : -sum.sign();
    };
    return side_of(segment.near_limit) >= 0 && side_of(segment.far_limit) <= 0;
}

// The axes of the permuted frame: (x, y, z) in it are components (axis + 1, axis + 2, axis).
template <class F>
Vec3<F> permuted(const Vec3<F>& v, int axis) {
    return axis == 0 ? Vec3<F>{v.y, v.z, v.x} : axis == 1 ? Vec3<F>{v.z, v.x, v.y} : v;
}

inline int dominant_axis(const Vec3f& d) {
    const float x = simd::abs(d.x), y = simd::abs(d.y), z = simd::abs(d.z);
    return x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
}

// The answer for one segment and one triangle: all others are shortcuts to this one.
inline bool meets(const Segment& segment, const Vec3f (&vertices)[3]) {
    const int axis = dominant_axis(segment.direction);
    const auto wide = [axis](const Vec3f& v) {
        return permuted(Vec3d{double{v.x}, double{v.y}, double{v.z}}, axis);
    };
    const Vec3d direction = wide(segment.direction);
    const ShearedSegment<double> sheared_segment = {
        wide(segment.origin), direction.x / direction.z, direction.y / direction.z,
        simd::min(segment.near_limit * direction.z, segment.far_limit * direction.z),
        simd::max(segment.near_limit * direction.z, segment.far_limit * direction.z)};
    const Vec3d wide_vertices[3] = {wide(vertices[0]), wide(vertices[1]), wide(vertices[2])};
    const Verdict<double> verdict = first_look(sheared_segment, wide_vertices);
    return verdict.meets || (!verdict.misses && meets_exactly(segment, vertices));
}

}  // namespace penumbra::shadow
