#pragma once

#include "core/frame/light_sums.h"
#include "core/frame/surface.h"
#include "core/frame/visibility.h"
#include "core/scene/scene.h"
#include "shadow/shade.h"
#include "tests/core/light_reference.h"

// Tiles of surface points and lights for the tests of the analytic passes.

namespace penumbra::light_testing {

namespace reference = light_reference;

inline Vec3f to_float(const Vec3d& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// One tile's planes.
struct TilePlanes {
    Plane3<float> position = plane3(), normal = plane3(), base_color = plane3(),
                  emission = plane3();
    Plane3<float> diffuse = plane3(), glossy = plane3(), shadow_origin = plane3(),
                  geometric = plane3();
    Plane<float> roughness = plane(), metallic = plane(), dielectric_f0 = plane(), depth = plane();
    Plane<float> motion_x = plane(), motion_y = plane();
    Plane<std::uint32_t> instance{kTileSize, kTileSize}, triangle{kTileSize, kTileSize};
    Plane<std::uint32_t> material{kTileSize, kTileSize};

    static Plane<float> plane() { return {kTileSize, kTileSize}; }
    static Plane3<float> plane3() { return make_plane3<float>(kTileSize, kTileSize); }

    SurfaceView surface() {
        return {.position = view(position),
                .shadow_origin = view(shadow_origin),
                .geometric_normal = view(geometric),
                .normal = view(normal),
                .base_color = view(base_color),
                .roughness = roughness.view(),
                .metallic = metallic.view(),
                .dielectric_f0 = dielectric_f0.view(),
                .emission = view(emission),
                .depth = depth.view(),
                .motion_x = motion_x.view(),
                .motion_y = motion_y.view(),
                .instance = instance.view(),
                .triangle = triangle.view(),
                .material = material.view()};
    }
    ConstSurfaceView const_surface() const {
        return {.position = view(position),
                .shadow_origin = view(shadow_origin),
                .geometric_normal = view(geometric),
                .normal = view(normal),
                .base_color = view(base_color),
                .roughness = roughness.view(),
                .metallic = metallic.view(),
                .dielectric_f0 = dielectric_f0.view(),
                .emission = view(emission),
                .depth = depth.view(),
                .motion_x = motion_x.view(),
                .motion_y = motion_y.view(),
                .instance = instance.view(),
                .triangle = triangle.view(),
                .material = material.view()};
    }
    LightSumsView sums() {
        return {.unshadowed_diffuse = view(diffuse),
                .unshadowed_glossy = view(glossy),
                .shadowed = {},
                .unshadowed_samples = {}};
    }
    void set(Plane3<float>& planes, int x, int y, const Vec3f& v) {
        planes[0].at(x, y) = v.x;
        planes[1].at(x, y) = v.y;
        planes[2].at(x, y) = v.z;
    }
    [[nodiscard]] static Vec3f get(const Plane3<float>& planes, int x, int y) {
        return {planes[0].at(x, y), planes[1].at(x, y), planes[2].at(x, y)};
    }
};

enum class Landscape { kFloor, kBumps, kChaos };

// A patch of ground of about `size` metres around a point, as the resolve would leave it.
inline void fill_tile(reference::Random& random, Landscape landscape, double size,
                      TilePlanes& tile) {
    const Vec3d base = random.direction() * (2 * size);
    const Vec3d albedo = {random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)};
    for (int y = 0; y < kTileSize; ++y) {
        for (int x = 0; x < kTileSize; ++x) {
            Vec3d point = base + Vec3d{(x - 32) * size / 64, 0, (y - 32) * size / 64};
            Vec3d normal{0, 1, 0};
            if (landscape == Landscape::kBumps)
                normal = normalize(Vec3d{0.2 * std::sin(x * 0.3), 1, 0.2 * std::cos(y * 0.2)});
            if (landscape == Landscape::kChaos) {
                point += random.direction() * size * 0.3;
                normal = random.direction();
            }
            tile.set(tile.position, x, y, to_float(point));
            tile.set(tile.normal, x, y, to_float(normal));
            tile.set(tile.base_color, x, y, to_float(albedo * random.uniform(0.7, 1)));
            tile.roughness.at(x, y) = static_cast<float>(random.uniform(0.3, 0.9));
            tile.metallic.at(x, y) =
                landscape == Landscape::kChaos ? static_cast<float>(random.uniform()) : 0.0f;
            tile.dielectric_f0.at(x, y) = 0.04f;
            tile.material.at(x, y) = random.uniform() < 0.1 ? kNothing : 0u;
            tile.depth.at(x, y) = 1;
        }
    }
}

inline PolygonLight make_light(const reference::Points& points, const Vec3f& radiance,
                               bool two_sided) {
    PolygonLight light;
    Vec3f vertices[kMaxPolygonVertices];
    for (std::size_t i = 0; i < points.size(); ++i) vertices[i] = to_float(points[i]);
    light.shape = make_polygon_shape(vertices, static_cast<int>(points.size()), two_sided);
    light.emission.radiance = radiance;
    return light;
}

// Lights of very different sizes, distances and colours around the origin.
inline SceneView random_lights(reference::Random& random, int count, double size) {
    SceneView scene;
    for (int i = 0; i < count; ++i) {
        const double extent = size * std::exp(random.uniform(-5, 0));
        const Vec3d center = random.direction() * (size * std::exp(random.uniform(0, 3)));
        const Vec3d u = random.direction();
        const Vec3d v = normalize(cross(u, random.direction()));
        const double power = std::exp(random.uniform(-3, 3));
        const Vec3f radiance = to_float(
            Vec3d{random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)} * power);
        const bool two_sided = random.uniform() < 0.3;
        scene.lights.add(
            make_light(reference::ellipse_polygon(random, center, u * extent, v * extent), radiance,
                       two_sided));
    }
    scene.camera.eye = to_float(random.direction() * (3 * size));
    return scene;
}

// The machine's instruction sets.
inline std::vector<simd::Isa> instruction_sets() {
    std::vector<simd::Isa> sets;
    for (const simd::Isa isa : {simd::Isa::kAvx2, simd::Isa::kAvx512})
        if (simd::is_supported(isa)) sets.push_back(isa);
    return sets;
}

}  // namespace penumbra::light_testing
