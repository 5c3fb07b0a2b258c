#pragma once

#include "core/math/vec.h"

// A planar, convex polygon light as the closed forms of core/light/polygon.h read it.

namespace penumbra {

inline constexpr int kMaxPolygonVertices = 8;

// Everything that does not depend on the shading point, formed once in double. The differences
// between vertices are what keeps the closed forms accurate for small and far lights: they are
// exact to the last place, while the same differences taken after subtracting a distant shading
// point are not. T is float or double; all vectors are in world space, lengths in metres.
template <class T>
struct PolygonShape {
    int count = 0;  // 3 to kMaxPolygonVertices, counter-clockwise seen from the side of `normal`
    bool two_sided = false;  // emits to the side of -normal too
    Vec3<T> vertices[kMaxPolygonVertices];
    Vec3<T> offsets[kMaxPolygonVertices];  // vertices[i] - vertices[0]
    Vec3<T> edges[kMaxPolygonVertices];    // vertices[i + 1] - vertices[i], the last one closes
    Vec3<T> moments[kMaxPolygonVertices];  // offsets[i] x edges[i]
    Vec3<T> normal;                        // unit
    Vec3<T> center;                        // of mass
    Vec3<T> spread[2];  // S = (s0 s0^T + s1 s1^T) / 2: the second central moments over the area
    T area = 0;
    T squared_spread = 0;  // (|s0|^2 + |s1|^2) / 2, the mean squared distance from the center
    T radius = 0;          // around the center
    // Heights above a plane up to this are taken for zero: the rounding of positions.
    T plane_tolerance = 0;
};

namespace detail {

inline Vec3d to_double(const auto& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
template <class T>
Vec3<T> from_double(const Vec3d& v) {
    return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}

// Twice the area, along the normal.
inline Vec3d area_vector(const Vec3d* offsets, int count) {
    Vec3d sum{0, 0, 0};
    for (int i = 1; i + 1 < count; ++i) sum += cross(offsets[i], offsets[i + 1]);
    return sum;
}

struct AreaMoments {
    Vec3d center{0, 0, 0};          // relative to the first vertex
    double xx = 0, xy = 0, yy = 0;  // central second moments per area along two axes
};

// By triangles of a fan: over a triangle with vertices a, b, c relative to the center,
// the mean of x x^T is (s s^T + a a^T + b b^T + c c^T) / 12 with s = a + b + c.
inline AreaMoments area_moments(const Vec3d* offsets, int count, const Vec3d& normal,
                                const Vec3d& x_axis, const Vec3d& y_axis) {
    AreaMoments moments;
    double total = 0;
    for (int i = 1; i + 1 < count; ++i) {
        const double area = dot(normal, cross(offsets[i], offsets[i + 1]));
        moments.center += (offsets[i] + offsets[i + 1]) * (area / 3);
        total += area;
    }
    moments.center = moments.center / total;
    for (int i = 1; i + 1 < count; ++i) {
        const double share = dot(normal, cross(offsets[i], offsets[i + 1])) / total / 12;
        const Vec3d corners[3] = {offsets[0] - moments.center, offsets[i] - moments.center,
                                  offsets[i + 1] - moments.center};
        const auto add = [&](const Vec3d& v) {
            const double x = dot(v, x_axis), y = dot(v, y_axis);
            moments.xx += share * x * x;
            moments.xy += share * x * y;
            moments.yy += share * y * y;
        };
        for (const Vec3d& corner : corners) add(corner);
        add(corners[0] + corners[1] + corners[2]);
    }
    return moments;
}

}  // namespace detail

// Takes the vertices relative to any origin; the area must not be zero.
template <class T>
PolygonShape<T> make_polygon_shape(const Vec3<T>* vertices, int count, bool two_sided = false) {
    PolygonShape<T> shape;
    shape.count = count;
    shape.two_sided = two_sided;
    Vec3d offsets[kMaxPolygonVertices];
    double extent = 0;
    for (int i = 0; i < count; ++i) {
        const Vec3d vertex = detail::to_double(vertices[i]);
        offsets[i] = vertex - detail::to_double(vertices[0]);
        extent = simd::max(extent, simd::sqrt(dot(vertex, vertex)));
    }
    const Vec3d doubled = detail::area_vector(offsets, count);
    const double doubled_area = length(doubled);
    const Vec3d normal = doubled / doubled_area;
    const Vec3d x_axis = normalize(offsets[1]);
    const Vec3d y_axis = cross(normal, x_axis);
    const detail::AreaMoments moments =
        detail::area_moments(offsets, count, normal, x_axis, y_axis);
    double radius = 0;
    for (int i = 0; i < count; ++i) {
        const Vec3d edge = offsets[i + 1 < count ? i + 1 : 0] - offsets[i];
        radius = simd::max(radius, length(offsets[i] - moments.center));
        shape.vertices[i] = vertices[i];
        shape.offsets[i] = detail::from_double<T>(offsets[i]);
        shape.edges[i] = detail::from_double<T>(edge);
        shape.moments[i] = detail::from_double<T>(cross(offsets[i], edge));
    }
    // Cholesky's factor of the moments: along the first edge, and what is left.
    const double along = simd::sqrt(moments.xx);
    const double skew = moments.xy / along;
    const double across = simd::sqrt(simd::max(0.0, moments.yy - skew * skew));
    const double root_two = simd::sqrt(2.0);
    shape.normal = detail::from_double<T>(normal);
    shape.center = detail::from_double<T>(detail::to_double(vertices[0]) + moments.center);
    shape.spread[0] = detail::from_double<T>((x_axis * along + y_axis * skew) * root_two);
    shape.spread[1] = detail::from_double<T>(y_axis * (across * root_two));
    shape.area = static_cast<T>(doubled_area / 2);
    shape.squared_spread = static_cast<T>(moments.xx + moments.yy);
    shape.radius = static_cast<T>(radius);
    shape.plane_tolerance =
        static_cast<T>(extent * (std::is_same_v<T, double> ? 0x1p-48 : 0x1p-20));
    return shape;
}

}  // namespace penumbra
