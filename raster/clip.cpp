#include "raster/clip.h"

#include <tuple>

namespace penumbra::raster {
namespace {

using Distance = float ClipDistances<float>::*;
constexpr Distance kPlanes[] = {&ClipDistances<float>::near_plane, &ClipDistances<float>::left,
                                &ClipDistances<float>::right, &ClipDistances<float>::top,
                                &ClipDistances<float>::bottom};

struct Polygon {
    Vec3f vertices[kMaxClippedTriangleVertices];
    int count = 0;
    void append(const Vec3f& v) { vertices[count++] = v; }
};

Vec3f crossing(Vec3f a, float distance_a, Vec3f b, float distance_b) {
    if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) {
        std::swap(a, b);
        std::swap(distance_a, distance_b);
    }
    return fma(b - a, distance_a / (distance_a - distance_b), a);
}

// Sutherland and Hodgman, "Reentrant Polygon Clipping" (1974), against one plane.
Polygon clip(const Camera& camera, const Polygon& polygon, Distance plane) {
    Polygon result;
    for (int k = 0; k < polygon.count; ++k) {
        const Vec3f& here = polygon.vertices[k];
        const Vec3f& next = polygon.vertices[(k + 1) % polygon.count];
        const float distance_here = clip_distances(camera, here).*plane;
        const float distance_next = clip_distances(camera, next).*plane;
        const bool here_is_inside = distance_here >= 0;
        if (here_is_inside) result.append(here);
        // Rounding can bend a clipped polygon so that it leaves a plane twice; what would not fit
        // is a sliver beyond the guard band.
        const bool crosses = here_is_inside != (distance_next >= 0);
        if (crosses && result.count < kMaxClippedTriangleVertices)
            result.append(crossing(here, distance_here, next, distance_next));
        if (result.count == kMaxClippedTriangleVertices) break;
    }
    return result;
}

}  // namespace

int clip_triangle(const Camera& camera, const Vec3f (&view)[3],
                  SnappedVertex (&clipped)[kMaxClippedTriangleVertices]) {
    Polygon polygon{{view[0], view[1], view[2]}, 3};
    for (const Distance plane : kPlanes) polygon = clip(camera, polygon, plane);
    if (polygon.count < 3) return 0;
    for (int k = 0; k < polygon.count; ++k) {
        const Vec2f pixel = project(camera, polygon.vertices[k]);
        clipped[k] = {snap(pixel.x), snap(pixel.y)};
    }
    return polygon.count;
}

}  // namespace penumbra::raster
