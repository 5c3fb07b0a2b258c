#include "shadow/draw_lights.h"

#include <algorithm>
#include <vector>

#include "shadow/draw_lights_kernel.h"

namespace penumbra::shadow {
namespace {

Vec3d to_double(const Vec3f& v) {
    return {v.x, v.y, v.z};
}
Vec3f to_float(const Vec3d& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// Can the light not touch the tile's pixels? A light that reaches behind the near plane always may.
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

// The edges' planes through the eye, oriented so that inside is positive on either side of the
// light.
DrawnLight seen_from_eye(const ShadedLight& light, const Vec3f& eye, double in_front) {
    const PolygonShape<float>& shape = light.shape;
    const double side = in_front > 0 ? 1 : -1;
    const Vec3d first = to_double(shape.vertices[0]) - to_double(eye);
    DrawnLight drawn{};
    drawn.edge_count = shape.count;
    for (int i = 0; i < shape.count; ++i) {
        const Vec3d normal = cross(first, to_double(shape.edges[i])) + to_double(shape.moments[i]);
        drawn.edge_normals[i] = to_float(normal * -side);
    }
    drawn.normal = to_float(to_double(shape.normal) * side);
    drawn.plane_distance = static_cast<float>(-in_front * side);
    drawn.radiance = light.radiance;
    drawn.previous_from_current = light.previous_from_current;
    return drawn;
}

}  // namespace

void draw_lights(const LightSet& set, const SceneView& view, const FrameContext& context,
                 const Tile& tile, const SurfaceView& surface) {
    std::vector<DrawnLight> drawn;
    for (const ShadedLight& light : set.lights) {
        const PolygonShape<float>& shape = light.shape;
        if (!light.visible || shape.count == 0) continue;
        const Vec3d from_light = to_double(view.camera.eye) - to_double(shape.vertices[0]);
        const double in_front = dot(to_double(shape.normal), from_light);
        if (in_front == 0 || (in_front < 0 && !shape.two_sided)) continue;
        if (misses_tile(shape, view.camera, tile)) continue;
        drawn.push_back(seen_from_eye(light, view.camera.eye, in_front));
    }
    if (drawn.empty()) return;
    simd::pick(context.isa, &avx2::draw_lights_in_tile,
               &avx512::draw_lights_in_tile)({.lights = drawn.data(),
                                              .light_count = static_cast<int>(drawn.size()),
                                              .camera = view.camera,
                                              .previous_camera = view.previous_camera,
                                              .x0 = tile.x0,
                                              .y0 = tile.y0,
                                              .surface = surface});
}

}  // namespace penumbra::shadow
