#include "shadow/polygon_kind.h"

#include <algorithm>

#include "core/math/widen.h"

namespace penumbra {

// The edges' planes through the eye, oriented so that inside is positive on either side of the
// light.
std::optional<PolygonOutline> see_outline(const PolygonShape<float>& shape, const Vec3f& eye) {
    const double in_front = dot(widen(shape.normal), widen(eye) - widen(shape.vertices[0]));
    if (in_front == 0 || (in_front < 0 && !shape.two_sided)) return std::nullopt;
    const double side = in_front > 0 ? 1 : -1;
    const Vec3d first = widen(shape.vertices[0]) - widen(eye);
    PolygonOutline outline{};
    outline.edge_count = shape.count;
    for (int i = 0; i < shape.count; ++i) {
        const Vec3d normal = cross(first, widen(shape.edges[i])) + widen(shape.moments[i]);
        outline.edge_normals[i] = narrow(normal * -side);
    }
    outline.normal = narrow(widen(shape.normal) * side);
    outline.plane_distance = static_cast<float>(-in_front * side);
    return outline;
}

bool misses_tile(const PolygonShape<float>& shape, const Camera& camera, const Tile& tile) {
    float x0 = 1e30f, y0 = 1e30f, x1 = -1e30f, y1 = -1e30f;
    for (int i = 0; i < shape.count; ++i) {
        const Vec3f view = camera.view_from_world(shape.vertices[i]);
        if (view.z < camera.near_distance) return false;
        const float x = camera.center_x + camera.focal * view.x / view.z;
        const float y = camera.center_y - camera.focal * view.y / view.z;
        x0 = std::min(x0, x);
        y0 = std::min(y0, y);
        x1 = std::max(x1, x);
        y1 = std::max(y1, y);
    }
    // A pixel of slack for the rounding of both this and the exact test.
    const auto left = static_cast<float>(tile.x0 - 1), top = static_cast<float>(tile.y0 - 1);
    const float extent = kTileSize + 2;
    return x1 < left || y1 < top || x0 > left + extent || y0 > top + extent;
}

}  // namespace penumbra
