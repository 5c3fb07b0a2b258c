#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <random>
#include <vector>

#include "core/parallel/tiles.h"
#include "core/scene/scene_view.h"
#include "raster/rasterize.h"
#include "raster/resolve.h"

// Scenes made by hand, and whole frames of what the rasterizer makes of them.

namespace penumbra::raster::testing {

// ---- meshes ------------------------------------------------------------------------------------

inline void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                         std::uint16_t slot = 0) {
    mesh.triangles.push_back({{a, b, c}});
    mesh.triangle_slots.push_back(slot);
}
inline std::uint32_t add_vertex(Mesh& mesh, Vec3f p, Vec3f n = {0, 0, 1}, Vec2f uv = {0, 0}) {
    mesh.positions.push_back(p);
    mesh.normals.push_back(n);
    mesh.uvs.push_back(uv);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

// (columns + 1) x (rows + 1) vertices at shape(u, v), with (u, v) in [0, 1]^2 as texture
// coordinates. Positions where u or v is 1 are those of 0 if the shape wraps: closed meshes share
// their floats.
template <class Shape>
Mesh parametric(int columns, int rows, const Shape& shape) {
    Mesh mesh;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            const Vec2f uv{static_cast<float>(i) / columns, static_cast<float>(j) / rows};
            const auto [p, n] = shape(i, j, uv);
            add_vertex(mesh, p, n, uv);
        }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            add_triangle(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1));
            add_triangle(mesh, at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    return mesh;
}

struct Placed {
    Vec3f position, normal;
};

inline Mesh sphere(int columns, int rows, Vec3f center = {0, 0, 0}, float radius = 1) {
    return parametric(columns, rows, [&](int i, int j, Vec2f) {
        const double phi = 2 * M_PI * (i % columns) / columns;
        const double theta = M_PI * j / rows;
        const double s = j == 0 || j == rows ? 0 : std::sin(theta);  // one point at each pole
        const Vec3f n{static_cast<float>(s * std::cos(phi)), static_cast<float>(-std::cos(theta)),
                      static_cast<float>(-s * std::sin(phi))};
        return Placed{center + n * radius, n};
    });
}

inline Mesh torus(int columns, int rows, float major = 1, float minor = 0.4f) {
    return parametric(columns, rows, [&](int i, int j, Vec2f) {
        const double phi = 2 * M_PI * (i % columns) / columns;
        const double theta = 2 * M_PI * (j % rows) / rows;
        const Vec3f out{static_cast<float>(std::cos(phi)), 0, static_cast<float>(-std::sin(phi))};
        const Vec3f n = out * static_cast<float>(std::cos(theta)) +
                        Vec3f{0, static_cast<float>(std::sin(theta)), 0};
        return Placed{out * major + n * minor, n};
    });
}

// Flat on z = 0, from (-half, -half) to (half, half), normals along +z.
inline Mesh grid(int columns, int rows, float half = 1) {
    return parametric(columns, rows, [&](int, int, Vec2f uv) {
        return Placed{{half * (2 * uv.x - 1), half * (2 * uv.y - 1), 0}, {0, 0, 1}};
    });
}

struct Soup {
    std::uint32_t seed = 1;
    int count = 100;
    float spread = 1;                     // half-axis of the cube of centres around the origin
    float smallest = 0.01f, largest = 1;  // sizes, log-uniform
};
inline Mesh soup(const Soup& s) {
    std::mt19937 random(s.seed);
    const auto between = [&](float low, float high) {
        return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24f;
    };
    const auto in_cube = [&](float half) {
        const float x = between(-half, half);
        const float y = between(-half, half);
        const float z = between(-half, half);
        return Vec3f{x, y, z};
    };
    Mesh mesh;
    for (int k = 0; k < s.count; ++k) {
        const Vec3f center = in_cube(s.spread);
        const float size = s.smallest * std::pow(s.largest / s.smallest, between(0, 1));
        Vec3f p[3];
        for (Vec3f& corner : p) corner = center + in_cube(size);
        const Vec3f n = cross(p[1] - p[0], p[2] - p[0]);
        const Vec3f unit = length(n) > 0 ? normalize(n) : Vec3f{0, 0, 1};
        const std::uint32_t a = add_vertex(mesh, p[0], unit, {0, 0});
        add_vertex(mesh, p[1], unit, {1, 0});
        add_vertex(mesh, p[2], unit, {0, 1});
        add_triangle(mesh, a, a + 1, a + 2);
    }
    return mesh;
}

// ---- scenes ------------------------------------------------------------------------------------

inline Camera look_at(Vec3f eye, Vec3f target, int width, int height, float degrees = 45) {
    Camera camera;
    camera.eye = eye;
    camera.forward = normalize(target - eye);
    const Vec3f up = std::abs(camera.forward.y) > 0.99f ? Vec3f{0, 0, 1} : Vec3f{0, 1, 0};
    camera.right = normalize(cross(camera.forward, up));
    camera.up = cross(camera.right, camera.forward);
    camera.focal = 0.5f * height / std::tan(degrees * static_cast<float>(M_PI) / 360);
    camera.center_x = 0.5f * width;
    camera.center_y = 0.5f * height;
    camera.near_distance = 0.01f;
    return camera;
}

// Owns what a SceneView points to.
struct TestScene {
    std::deque<Mesh> meshes;
    std::deque<std::vector<std::uint32_t>> slots;
    std::vector<Material> materials{Material{}};
    std::vector<Texture> textures;
    SceneView view;
    int width, height;

    TestScene(int w, int h, const Camera& camera) : width(w), height(h) {
        view.camera = view.previous_camera = camera;
    }
    TestScene(const TestScene&) = delete;

    // Materials by slot; `map` places the mesh.
    Instance& add(Mesh mesh, std::vector<std::uint32_t> materials_of_slots = {0},
                  const Affine3f& map = {}) {
        meshes.push_back(std::move(mesh));
        slots.push_back(std::move(materials_of_slots));
        Instance instance;
        instance.mesh = &meshes.back();
        instance.materials = slots.back();
        for (const Vec3f& p : meshes.back().positions) instance.positions.push_back(map.point(p));
        instance.positions.push_back({0, 0, 0});
        for (const Vec3f& n : meshes.back().normals)
            instance.normals.push_back(normalize(map.vector(n)));
        instance.world_from_object = map;
        view.instances.push_back(instance);
        return view.instances.back();
    }
    // After the last change.
    const SceneView& finish() {
        view.materials = materials;
        view.textures = textures;
        return view;
    }
    [[nodiscard]] FrameContext frame(simd::Isa isa = simd::best_isa()) const {
        return {.width = width, .height = height, .isa = isa};
    }
    [[nodiscard]] PixelRect all_pixels() const { return {0, 0, width, height}; }
};

// ---- frames ------------------------------------------------------------------------------------

struct Frame {
    Frame(int width, int height) : instance(width, height), triangle(width, height) {
        for (Plane3<float>* planes :
             {&position, &shadow_origin, &geometric_normal, &normal, &base_color, &emission})
            *planes = make_plane3<float>(width, height);
        for (Plane<float>* plane :
             {&roughness, &metallic, &dielectric_f0, &depth, &motion_x, &motion_y})
            *plane = Plane<float>(width, height);
        for (Plane<std::uint32_t>* plane : {&surface_instance, &surface_triangle, &material})
            *plane = Plane<std::uint32_t>(width, height);
    }
    [[nodiscard]] VisibilityView visibility() { return {instance.view(), triangle.view()}; }
    [[nodiscard]] SurfaceView surface() {
        return {.position = view(position),
                .shadow_origin = view(shadow_origin),
                .geometric_normal = view(geometric_normal),
                .normal = view(normal),
                .base_color = view(base_color),
                .roughness = roughness.view(),
                .metallic = metallic.view(),
                .dielectric_f0 = dielectric_f0.view(),
                .emission = view(emission),
                .depth = depth.view(),
                .motion_x = motion_x.view(),
                .motion_y = motion_y.view(),
                .instance = surface_instance.view(),
                .triangle = surface_triangle.view(),
                .material = material.view()};
    }
    // Calls see(plane) for every plane of floats and of ids.
    template <class See>
    void each_plane(const See& see) const {
        for (const Plane3<float>* planes :
             {&position, &shadow_origin, &geometric_normal, &normal, &base_color, &emission})
            for (const Plane<float>& plane : *planes) see(plane);
        for (const Plane<float>* plane :
             {&roughness, &metallic, &dielectric_f0, &depth, &motion_x, &motion_y})
            see(*plane);
        for (const Plane<std::uint32_t>* plane :
             {&instance, &triangle, &surface_instance, &surface_triangle, &material})
            see(*plane);
    }
    [[nodiscard]] Vec3f at(const Plane3<float>& planes, int x, int y) const {
        return {planes[0].at(x, y), planes[1].at(x, y), planes[2].at(x, y)};
    }

    Plane<std::uint32_t> instance, triangle, surface_instance, surface_triangle, material;
    Plane3<float> position, shadow_origin, geometric_normal, normal, base_color, emission;
    Plane<float> roughness, metallic, dielectric_f0, depth, motion_x, motion_y;
};

template <class T>
PlaneView<T> part(const PlaneView<T>& plane, int x, int y) {
    return plane ? plane.offset(x, y) : plane;
}
template <class T>
PlaneView3<T> part(const PlaneView3<T>& planes, int x, int y) {
    return {part(planes[0], x, y), part(planes[1], x, y), part(planes[2], x, y)};
}
inline SurfaceView part(const SurfaceView& s, int x, int y) {
    return {.position = part(s.position, x, y),
            .shadow_origin = part(s.shadow_origin, x, y),
            .geometric_normal = part(s.geometric_normal, x, y),
            .normal = part(s.normal, x, y),
            .base_color = part(s.base_color, x, y),
            .roughness = part(s.roughness, x, y),
            .metallic = part(s.metallic, x, y),
            .dielectric_f0 = part(s.dielectric_f0, x, y),
            .emission = part(s.emission, x, y),
            .depth = part(s.depth, x, y),
            .motion_x = part(s.motion_x, x, y),
            .motion_y = part(s.motion_y, x, y),
            .instance = part(s.instance, x, y),
            .triangle = part(s.triangle, x, y),
            .material = part(s.material, x, y)};
}

// The G-buffer of a window, in planes of the full frame.
inline Frame render(TestScene& scene, const parallel::Arena& arena, simd::Isa isa,
                    const PixelRect& window) {
    Frame frame(scene.width, scene.height);
    const SceneView& view = scene.finish();
    const FrameContext context = scene.frame(isa);
    Geometry geometry;
    prepare(view, context, window, arena, geometry);
    std::vector<Scratch> scratch(static_cast<std::size_t>(arena.threads()));
    const parallel::TileGrid tiles(window);
    arena.for_each(tiles.count(), [&](int index, int worker) {
        const Tile tile = tiles.tile(index);
        const VisibilityView visibility{part(frame.visibility().instance, tile.x0, tile.y0),
                                        part(frame.visibility().triangle, tile.x0, tile.y0)};
        rasterize(view, geometry, tile, isa, scratch[worker], visibility);
        resolve(view, geometry, context, tile, visibility, part(frame.surface(), tile.x0, tile.y0));
    });
    return frame;
}
inline Frame render(TestScene& scene) {
    const parallel::Arena arena(1);
    return render(scene, arena, simd::best_isa(), scene.all_pixels());
}

// How often each pixel of the frame is covered.
struct Coverage {
    Coverage(int width, int height) : front(width, height), back(width, height) {}
    Plane<std::int32_t> front, back;
};
inline Coverage count(TestScene& scene, simd::Isa isa = simd::best_isa()) {
    Coverage coverage(scene.width, scene.height);
    const parallel::Arena arena(1);
    const SceneView& view = scene.finish();
    Geometry geometry;
    prepare(view, scene.frame(isa), scene.all_pixels(), arena, geometry);
    const parallel::TileGrid tiles(scene.all_pixels());
    const auto scratch = std::make_unique<Scratch>();
    for (int index = 0; index < tiles.count(); ++index) {
        const Tile tile = tiles.tile(index);
        count_coverage(view, geometry, tile, isa, *scratch,
                       part(coverage.front.view(), tile.x0, tile.y0),
                       part(coverage.back.view(), tile.x0, tile.y0));
    }
    return coverage;
}

}  // namespace penumbra::raster::testing
