#pragma once

#include "core/math/affine.h"
#include "core/math/triangle.h"
#include "raster/snapped.h"
#include "raster/texture_map.h"

// The formulas of the resolve, one surface point at a time; see core/frame/surface.h.

namespace penumbra::raster {

template <class F>
struct SurfaceTriangle {
    Vec3<F> positions[3];  // world
    Vec3<F> normals[3];    // world, unit
    Vec2<F> uvs[3];
};

// The point of a triangle behind a pixel.
template <class F>
struct SurfacePoint {
    PlaneEquations<F> plane;
    Barycentrics<F> weights;
    Vec3<F> edge_1, edge_2;    // from vertex 0
    Vec3<F> from_vertex;       // vertex 0 -> point: small, where the triangle is, and so precise
    Vec3<F> from_eye;          // eye -> point
    F depth;                   // along the view axis
    Vec3<F> view;              // unit, point -> eye
    Vec3<F> geometric_normal;  // unit, towards the viewer
    simd::MaskOf<F> is_front;  // the viewer sees the vertices counter-clockwise
};

// Unit vector along `a`, or `otherwise` where `a` has no direction. Scaled first, so that triangles
// of micrometres and of light years have normals.
template <class F>
Vec3<F> direction_or(const Vec3<F>& a, const Vec3<F>& otherwise) {
    const F largest = simd::max(simd::max(simd::abs(a.x), simd::abs(a.y)), simd::abs(a.z));
    const auto has_direction = (largest > F(1e-30f)) & (largest < F(1e30f));
    const F scale = F(1) / simd::select(has_direction, largest, F(1));
    return select(has_direction, normalize(a * scale), otherwise);
}

template <class F>
SurfacePoint<F> surface_point(const SurfaceTriangle<F>& triangle, const Camera& camera,
                              const Vec3<F>& direction) {
    const RelativeTriangle<F> relative =
        relative_triangle(broadcast<F>(camera.eye), triangle.positions[0], triangle.positions[1],
                          triangle.positions[2]);
    SurfacePoint<F> point;
    point.plane = plane_equations(relative);
    point.weights = clamped_barycentrics(point.plane, direction);
    point.edge_1 = relative.edge_1;
    point.edge_2 = relative.edge_2;
    point.from_vertex = fma(relative.edge_1, point.weights.b1, relative.edge_2 * point.weights.b2);
    point.from_eye = relative.vertex + point.from_vertex;
    point.depth = clamped_distance(relative, point.plane, direction, broadcast<F>(camera.forward));
    point.view = direction_or(-point.from_eye, -direction);
    point.is_front = dot(point.plane.normal, relative.vertex) < F(0);
    const Vec3<F> unit = direction_or(point.plane.normal, point.view);
    // A plane seen edge-on may face away by rounding.
    point.geometric_normal = select(dot(unit, point.view) < F(0), -unit, unit);
    return point;
}

// a0 (1 - b1 - b2) + a1 b1 + a2 b2
template <class F, class V>
V interpolate(const V (&a)[3], const Barycentrics<F>& b) {
    return a[0] + (a[1] - a[0]) * b.b1 + (a[2] - a[0]) * b.b2;
}

// Do the vertex normals lie on the other side than the viewer? The same for all points of a
// triangle seen from one side.
template <class F>
simd::MaskOf<F> normals_face_away(const SurfaceTriangle<F>& triangle,
                                  const Vec3<F>& geometric_normal) {
    const Vec3<F> sum = triangle.normals[0] + triangle.normals[1] + triangle.normals[2];
    return dot(sum, geometric_normal) < F(0);
}

// How far a shading normal is kept above the horizons of viewer and surface: a cosine. Small
// against the 0.02 at which linearly transformed cosines are tabulated last, large against float's
// rounding.
inline constexpr float kGrazingCosine = 1e-3f;

template <class F>
Vec3<F> bend_above_horizon(const Vec3<F>& normal, const Vec3<F>& up) {
    const F missing = simd::max(F(kGrazingCosine) - dot(normal, up), F(0));
    return direction_or(fma(up, missing, normal), up);
}

// The shading normal, made fit for use: on the viewer's side, above the surface, and not facing
// away from the viewer. `up` of the second step is above the surface, so it does not undo the
// first.
template <class F>
Vec3<F> bent_to_viewer(const Vec3<F>& normal, const SurfacePoint<F>& point) {
    return bend_above_horizon(bend_above_horizon(normal, point.geometric_normal), point.view);
}

// Derivatives of the texture coordinates by the pixel position, exact for the perspective: with
// b = (w . d) / (n . d), db = (w . dd - b n . dd) / (n . d).
template <class F>
TextureFootprint<F> texture_footprint(const Camera& camera, const SurfaceTriangle<F>& triangle,
                                      const SurfacePoint<F>& point, const Vec3<F>& direction) {
    const F per_pixel = F(1.0f / camera.focal) / dot(point.plane.normal, direction);
    const Vec2<F> uv_1 = triangle.uvs[1] - triangle.uvs[0];
    const Vec2<F> uv_2 = triangle.uvs[2] - triangle.uvs[0];
    const auto change = [&](const Vec3<F>& axis) {
        const F n = dot(point.plane.normal, axis);
        const F b1 = (dot(point.plane.weight_1, axis) - point.weights.b1 * n) * per_pixel;
        const F b2 = (dot(point.plane.weight_2, axis) - point.weights.b2 * n) * per_pixel;
        return uv_1 * b1 + uv_2 * b2;
    };
    return {interpolate(triangle.uvs, point.weights), change(broadcast<F>(camera.right)),
            change(-broadcast<F>(camera.up))};
}

// A tangent-space normal turned into the world. The tangent runs along increasing u and the
// bitangent along increasing v on the triangle; both are made orthogonal to the smooth normal.
// Where the texture has no orientation there, the smooth normal itself.
template <class F>
Vec3<F> mapped_normal(const SurfaceTriangle<F>& triangle, const SurfacePoint<F>& point,
                      const Vec3<F>& smooth, const Vec3<F>& tangent_space) {
    const Vec2<F> uv_1 = triangle.uvs[1] - triangle.uvs[0];
    const Vec2<F> uv_2 = triangle.uvs[2] - triangle.uvs[0];
    const F orientation = simd::fma(uv_1.x, uv_2.y, -(uv_1.y * uv_2.x));
    const F sign = simd::copysign(F(1), orientation);
    const Vec3<F> along_u = (point.edge_1 * uv_2.y - point.edge_2 * uv_1.y) * sign;
    const Vec3<F> along_v = (point.edge_2 * uv_1.x - point.edge_1 * uv_2.x) * sign;

    const Vec3<F> zero = smooth * F(0);
    const Vec3<F> unit_u = direction_or(along_u, zero);
    const Vec3<F> tangent = direction_or(unit_u - smooth * dot(unit_u, smooth), zero);
    const Vec3<F> across = cross(smooth, tangent);
    const Vec3<F> bitangent = across * simd::copysign(F(1), dot(across, along_v));
    const auto has_frame = (orientation != F(0)) & (dot(tangent, tangent) > F(0.5f));
    const Vec3<F> mapped =
        fma(tangent, tangent_space.x, fma(bitangent, tangent_space.y, smooth * tangent_space.z));
    return select(has_frame, direction_or(mapped, smooth), smooth);
}

// From the point to where its shadow rays start: onto the tangent planes of the vertices where the
// point lies below them, so that smooth-shaded facets do not shadow themselves. Hanika, "Hacking
// the Shadow Terminator", Ray Tracing Gems II (2021), ch. 4. Differs: vertex normals are those of
// the viewer's side, and there is no offset where it would lead through the surface.
template <class F>
Vec3<F> shadow_offset(const SurfaceTriangle<F>& triangle, const SurfacePoint<F>& point,
                      const simd::MaskOf<F>& normals_away) {
    const F b[3] = {F(1) - point.weights.b1 - point.weights.b2, point.weights.b1, point.weights.b2};
    const Vec3<F> from_vertices[3] = {point.from_vertex, point.from_vertex - point.edge_1,
                                      point.from_vertex - point.edge_2};
    Vec3<F> offset{F(0), F(0), F(0)};
    for (int k = 0; k < 3; ++k) {
        const Vec3<F> normal = select(normals_away, -triangle.normals[k], triangle.normals[k]);
        const F below = simd::min(dot(from_vertices[k], normal), F(0));
        offset = fma(normal, -(b[k] * below), offset);
    }
    const auto is_outward = dot(offset, point.geometric_normal) > F(0);
    return select(is_outward, offset, Vec3<F>{F(0), F(0), F(0)});
}

}  // namespace penumbra::raster
