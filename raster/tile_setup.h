#pragma once

#include "core/math/triangle.h"
#include "raster/edges.h"
#include "raster/tile_memory.h"

// A triangle as the pixels of one tile see it.

namespace penumbra::raster {

// 1 / z at the tile's first pixel, its steps, and the range of the triangle's vertices. Per metre.
template <class F>
struct DepthPlane {
    F value, step_x, step_y, low, high;
};

// The inverse depth is (N . d) / (N . p0): affine in the pixel position, because d is.
template <class F>
DepthPlane<F> depth_plane(const Camera& camera, const Tile& tile, const Vec3<F> (&p)[3]) {
    const Vec3<F> from_eye = p[0] - broadcast<F>(camera.eye);
    const Vec3<F> edge_1 = p[1] - p[0];
    const Vec3<F> edge_2 = p[2] - p[0];
    const Vec3<F> normal = cross(edge_1, edge_2);
    const Vec3<F> scaled = normal * (F(1) / dot(normal, from_eye));
    const Vec3<F> forward = broadcast<F>(camera.forward);
    const F pixel(1.0f / camera.focal);

    const F z0 = dot(from_eye, forward);
    const F z1 = z0 + dot(edge_1, forward);
    const F z2 = z0 + dot(edge_2, forward);
    const F near_distance(camera.near_distance);
    const F nearest = simd::max(simd::min(simd::min(z0, z1), z2), near_distance);
    const F farthest = simd::max(simd::max(simd::max(z0, z1), z2), near_distance);
    const Vec3<F> first = camera.direction(F(static_cast<float>(tile.x0) + 0.5f),
                                           F(static_cast<float>(tile.y0) + 0.5f));
    return {dot(first, scaled), dot(broadcast<F>(camera.right), scaled) * pixel,
            -(dot(broadcast<F>(camera.up), scaled) * pixel), F(1) / farthest, F(1) / nearest};
}

// Pixels of the tile, inclusive.
struct PixelBounds {
    std::int32_t x0, y0, x1, y1;
};

// What the loops over cells read: of one triangle, or of a piece of a clipped one.
struct TileTriangle {
    PixelEdge<std::int32_t> edges[3];
    DepthPlane<float> depth;
    PixelBounds bounds;
    std::uint32_t index;      // of the instance's mesh
    bool is_front;            // the snapped vertices run counter-clockwise on the screen
    const CutoutMap* cutout;  // or null
};

// Edges of any snapped triangle and its bounds in the tile; false if it covers nothing there. An
// edge that the whole tile is inside of becomes zero: then the others fit into 32 bits, because an
// edge function that changes its sign within the tile is at most 63 (|step_x| + |step_y|) anywhere
// in it, and steps are differences of 24-bit coordinates.
inline bool set_up_edges(SnappedVertex a, SnappedVertex b, SnappedVertex c, const Tile& tile,
                         TileTriangle& triangle) {
    using Wide = std::int64_t;
    const Wide area = doubled_area<Wide>(a.x, a.y, b.x, b.y, c.x, c.y);
    triangle.is_front = area < 0;
    if (area < 0) {
        const SnappedVertex swapped = b;
        b = c;
        c = swapped;
    }
    constexpr int kLast = kTileSize - 1;
    const SnappedVertex v[3] = {a, b, c};
    for (int k = 0; k < 3; ++k) {
        const SnappedVertex& from = v[k];
        const SnappedVertex& to = v[(k + 1) % 3];
        const PixelEdge<Wide> edge = pixel_edge<Wide>(from.x, from.y, to.x, to.y,
                                                      pixel_center(tile.x0), pixel_center(tile.y0));
        const Wide lowest = edge.value + (edge.step_x < 0 ? edge.step_x * kLast : 0) +
                            (edge.step_y < 0 ? edge.step_y * kLast : 0);
        const Wide highest = edge.value + (edge.step_x > 0 ? edge.step_x * kLast : 0) +
                             (edge.step_y > 0 ? edge.step_y * kLast : 0);
        if (highest < 0) return false;
        const bool inside = lowest >= 0;
        triangle.edges[k] = {inside ? 0 : static_cast<std::int32_t>(edge.value),
                             inside ? 0 : static_cast<std::int32_t>(edge.step_x),
                             inside ? 0 : static_cast<std::int32_t>(edge.step_y)};
    }
    const auto least = [](int p, int q, int r) { return simd::min(simd::min(p, q), r); };
    const auto most = [](int p, int q, int r) { return simd::max(simd::max(p, q), r); };
    triangle.bounds = {simd::max(first_pixel(least(a.x, b.x, c.x)) - tile.x0, 0),
                       simd::max(first_pixel(least(a.y, b.y, c.y)) - tile.y0, 0),
                       simd::min(last_pixel(most(a.x, b.x, c.x)) - tile.x0, kLast),
                       simd::min(last_pixel(most(a.y, b.y, c.y)) - tile.y0, kLast)};
    return triangle.bounds.x0 <= triangle.bounds.x1 && triangle.bounds.y0 <= triangle.bounds.y1;
}

}  // namespace penumbra::raster
