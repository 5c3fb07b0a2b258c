#pragma once

#include "core/math/vec.h"

namespace penumbra {

// A triangle as a line through the origin meets it: vertex 0 relative to the origin, and the edges
// from it. Edges are differences of vertices, not of relative vertices: they keep their precision
// far from the origin.
template <class F>
struct RelativeTriangle {
    Vec3<F> vertex;          // 0
    Vec3<F> edge_1, edge_2;  // to vertices 1 and 2
};

template <class F>
RelativeTriangle<F> relative_triangle(const Vec3<F>& origin, const Vec3<F>& p0, const Vec3<F>& p1,
                                      const Vec3<F>& p2) {
    return {p0 - origin, p1 - p0, p2 - p0};
}

// Homogeneous plane equations: along a direction d the line meets the triangle's plane at
//   distance (normal . vertex) / (normal . d), weights (weight_1 . d) / (normal . d) of vertex 1
//   and (weight_2 . d) / (normal . d) of vertex 2.
// Olano and Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates" (1997), section 3.
template <class F>
struct PlaneEquations {
    Vec3<F> normal;  // of the side from which the vertices run counter-clockwise; not a unit vector
    Vec3<F> weight_1, weight_2;
};

template <class F>
PlaneEquations<F> plane_equations(const RelativeTriangle<F>& t) {
    return {cross(t.edge_1, t.edge_2), cross(t.edge_2, t.vertex), cross(t.vertex, t.edge_1)};
}

// How far along `direction` the line meets the triangle's plane, held between the triangle's
// nearest and farthest vertex; in lengths of `direction`, whose component along `axis` is 1. On
// thin triangles it has digits that the weights, differences of nearly equal numbers, have lost.
template <class F>
F clamped_distance(const RelativeTriangle<F>& t, const PlaneEquations<F>& plane,
                   const Vec3<F>& direction, const Vec3<F>& axis) {
    const F at_0 = dot(t.vertex, axis);
    const F at_1 = dot(t.vertex + t.edge_1, axis);
    const F at_2 = dot(t.vertex + t.edge_2, axis);
    const F distance = dot(plane.normal, t.vertex) / dot(plane.normal, direction);
    return simd::clamp(distance, simd::min(simd::min(at_0, at_1), at_2),
                       simd::max(simd::max(at_0, at_1), at_2));
}

// Weights of vertices 1 and 2; what is left of 1 is vertex 0's.
template <class F>
struct Barycentrics {
    F b1, b2;
};

// Where the line along `direction` meets the triangle's plane, or, if that is outside the triangle,
// a point of its border. Finite also for planes seen edge-on.
template <class F>
Barycentrics<F> clamped_barycentrics(const PlaneEquations<F>& plane, const Vec3<F>& direction) {
    const F scale = F(1) / dot(plane.normal, direction);
    const F b1 = simd::saturate(dot(plane.weight_1, direction) * scale);
    const F b2 = simd::saturate(dot(plane.weight_2, direction) * scale);
    const F excess = F(1) / simd::max(b1 + b2, F(1));
    return {b1 * excess, b2 * excess};
}

}  // namespace penumbra
