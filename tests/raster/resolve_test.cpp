#include <doctest/doctest.h>

#include "core/bsdf/ggx.h"
#include "core/math/widen.h"
#include "tests/raster/scenes.h"

using namespace penumbra;
using namespace penumbra::raster;
using namespace penumbra::raster::testing;

namespace {

// The pixel a world point falls on.
Vec2<double> pixel_of(const Camera& camera, const Vec3d& world) {
    const Vec3d d = world - widen(camera.eye);
    const double z = dot(d, widen(camera.forward));
    return {camera.center_x + camera.focal * dot(d, widen(camera.right)) / z,
            camera.center_y - camera.focal * dot(d, widen(camera.up)) / z};
}

template <class See>  // see(x, y)
void each_hit(const TestScene& scene, const Frame& frame, const See& see) {
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x)
            if (frame.instance.at(x, y) != 0xFFFFFFFFu) see(x, y);
}

// Every level has one value: its number. A lookup then reads the mip level itself.
Texture level_numbers(int size) {
    Texture texture;
    for (int s = size, level = 0;; s /= 2, ++level) {
        texture.levels.push_back({s, s, static_cast<std::int32_t>(texture.texels.size())});
        const auto value = static_cast<std::uint32_t>(level * 4096);
        for (int k = 0; k < s * s; ++k) {
            texture.texels.push_back(value | value << 16);
            texture.texels.push_back(value | 65535u << 16);
        }
        if (s == 1) return texture;
    }
}

Texture uniform(std::array<std::uint32_t, 4> rgba) {
    Texture texture;
    texture.levels.push_back({1, 1, 0});
    texture.texels = {rgba[0] | rgba[1] << 16, rgba[2] | rgba[3] << 16};
    return texture;
}

Texture random_alpha(int width, int height) {
    Texture texture;
    std::mt19937 random(5);
    texture.levels.push_back({width, height, 0});
    for (int k = 0; k < 2 * width * height; ++k)
        texture.texels.push_back(static_cast<std::uint32_t>(random()));
    return texture;
}

// A unit square on z = 0, facing the camera at (0, 0, 2).
constexpr int kSize = 96;
Camera front_camera() {
    return look_at({0, 0, 2}, {0, 0, 0}, kSize, kSize, 60);
}

}  // namespace

TEST_CASE("positions lie on the pixel's ray and depth is measured along the view axis") {
    TestScene scene(200, 150, look_at({0.3f, 1, 3}, {0, 0, 0}, 200, 150));
    scene.add(torus(60, 30));
    const Frame frame = render(scene);
    double farthest = 0, depth_error = 0;
    int pixels = 0, slid = 0;
    each_hit(scene, frame, [&](int x, int y) {
        const Vec3d p = widen(frame.at(frame.position, x, y));
        const Vec2<double> pixel = pixel_of(scene.view.camera, p);
        farthest = std::max(farthest, std::hypot(pixel.x - x - 0.5, pixel.y - y - 0.5));
        const Vec3d d = p - widen(scene.view.camera.eye);
        const double depth = dot(d, widen(scene.view.camera.forward));
        depth_error = std::max(depth_error, std::abs(frame.depth.at(x, y) / depth - 1));
        slid += std::abs(frame.depth.at(x, y) / depth - 1) > 1e-6;
        ++pixels;
    });
    CHECK(farthest < 0.01);  // up to the snapping of silhouettes
    // A position is clamped to its triangle, which slides it along a slanted one; depth is the
    // ray's.
    CHECK(slid < pixels / 100);
    CHECK(depth_error < 1e-4);
}

TEST_CASE("motion is that of the point's projections in double precision") {
    TestScene scene(200, 150, look_at({0.3f, 1, 3}, {0, 0, 0}, 200, 150));
    Instance& instance = scene.add(torus(60, 30));
    instance.previous_from_current = {
        {0.98f, 0.02f, 0}, {-0.02f, 0.97f, 0.01f}, {0.03f, 0, 1.01f}, {0.1f, -0.05f, 0.02f}};
    scene.view.previous_camera = look_at({0.2f, 1.1f, 2.9f}, {0.05f, 0, 0}, 200, 150);
    const Frame frame = render(scene);
    double worst = 0;
    each_hit(scene, frame, [&](int x, int y) {
        const Vec3d p = widen(frame.at(frame.position, x, y));
        const Affine3f& map = scene.view.instances[0].previous_from_current;
        const Vec3d before = widen(map.column_x) * p.x + widen(map.column_y) * p.y +
                             widen(map.column_z) * p.z + widen(map.translation);
        const Vec2<double> now = pixel_of(scene.view.camera, p);
        const Vec2<double> then = pixel_of(scene.view.previous_camera, before);
        worst = std::max({worst, std::abs(frame.motion_x.at(x, y) - (now.x - then.x)),
                          std::abs(frame.motion_y.at(x, y) - (now.y - then.y))});
    });
    CHECK(worst < 2e-4);  // pixels
}

TEST_CASE("what stands still moves by exactly nothing") {
    const Vec3f far{12345, 678, -9000};
    TestScene scene(200, 150, look_at(far + Vec3f{0.3f, 1, 3}, far, 200, 150));
    Affine3f map;
    map.translation = far;
    scene.add(torus(60, 30), {0}, map);
    const Frame frame = render(scene);
    each_hit(scene, frame, [&](int x, int y) {
        REQUIRE(frame.motion_x.at(x, y) == 0);
        REQUIRE(frame.motion_y.at(x, y) == 0);
    });
}

TEST_CASE("normals are unit vectors on the viewer's side of surface and horizon") {
    TestScene scene(200, 150, look_at({0.3f, 1, 3}, {0, 0, 0}, 200, 150));
    scene.textures.push_back(random_alpha(16, 16));  // a wild normal map
    scene.materials[0].normal_map = 0;
    scene.add(torus(16, 8));  // coarse: silhouettes whose smooth normals face away
    Mesh inside_out = sphere(20, 10, {0, 0, 0}, 0.5f);
    for (Vec3f& n : inside_out.normals) n = -n;
    scene.add(std::move(inside_out));
    const Frame frame = render(scene);
    each_hit(scene, frame, [&](int x, int y) {
        const Vec3f p = frame.at(frame.position, x, y);
        const Vec3f view = normalize(scene.view.camera.eye - p);
        const Vec3f n = frame.at(frame.normal, x, y);
        const Vec3f g = frame.at(frame.geometric_normal, x, y);
        REQUIRE(std::abs(length(n) - 1) < 1e-5f);
        REQUIRE(std::abs(length(g) - 1) < 1e-5f);
        REQUIRE(dot(g, view) > -1e-6f);
        REQUIRE(dot(n, view) > 0);
        REQUIRE(dot(n, g) > 0);
    });
}

TEST_CASE("smooth normals are interpolated with the weights of the point") {
    TestScene scene(200, 150, look_at({0.3f, 1, 3}, {0, 0, 0}, 200, 150));
    scene.add(sphere(300, 200));
    const Frame frame = render(scene);
    double worst = 0;
    each_hit(scene, frame, [&](int x, int y) {
        const Vec3f p = frame.at(frame.position, x, y);
        if (dot(normalize(p), normalize(scene.view.camera.eye - p)) < 0.05f) return;
        worst = std::max<double>(worst, length(frame.at(frame.normal, x, y) - normalize(p)));
    });
    CHECK(worst < 1e-3);  // of a facet's linear interpolation
}

TEST_CASE("a normal map is turned by the directions of u and v, seen from either side") {
    // Tangent-space (0.6, 0, 0.8): on the square, u runs along +x.
    for (const float side : {1.0f, -1.0f}) {
        TestScene scene(kSize, kSize, look_at({0, 0, 2 * side}, {0, 0, 0}, kSize, kSize, 60));
        scene.textures.push_back(uniform({52428, 32768, 58982, 65535}));
        scene.materials[0].normal_map = 0;
        scene.add(grid(2, 2));
        const Frame frame = render(scene);
        const Vec3f n = frame.at(frame.normal, kSize / 2 + 3, kSize / 2 + 5);
        CHECK(length(n - Vec3f{0.6f, 0, 0.8f} * side) < 1e-3f);
    }
    // v runs along +y; with u mirrored the bitangent stays along v.
    TestScene scene(kSize, kSize, front_camera());
    scene.textures.push_back(uniform({52428, 45875, 52428, 65535}));  // (0.6, 0.4, 0.6)
    scene.materials[0].normal_map = 0;
    Mesh mirrored = grid(2, 2);
    for (Vec2f& uv : mirrored.uvs) uv.x = 1 - uv.x;
    scene.add(std::move(mirrored));
    const Frame frame = render(scene);
    const Vec3f expected = normalize(Vec3f{-0.6f, 0.4f, 0.6f});
    CHECK(length(frame.at(frame.normal, kSize / 2 + 3, kSize / 2 + 5) - expected) < 1e-3f);
}

TEST_CASE("the mip level follows the screen-space derivatives of the texture coordinates") {
    TestScene scene(256, 192, look_at({0, 0.5f, 3}, {0, 0, -2}, 256, 192, 60));
    scene.textures.push_back(level_numbers(1024));
    scene.materials[0].base_color_map = 0;
    scene.materials[0].base_color = {1, 1, 1};
    Mesh floor = grid(3, 3, 6);
    for (Vec3f& p : floor.positions) p = {p.x, 0.03f * p.x, -p.y};
    scene.add(std::move(floor));
    const Frame frame = render(scene);
    // Texture coordinates of the plane behind a pixel, by intersecting it in double.
    const auto uv = [&](double px, double py) {
        const Camera& c = scene.view.camera;
        const Vec3d d = widen(c.right) * ((px - c.center_x) / c.focal) +
                        widen(c.up) * ((c.center_y - py) / c.focal) + widen(c.forward);
        const Vec3d n{-0.03, 1, 0};
        const double t = -dot(n, widen(c.eye)) / dot(n, d);
        const Vec3d p = widen(c.eye) + d * t;
        return Vec2<double>{(p.x / 6 + 1) / 2, (-p.z / 6 + 1) / 2};
    };
    double worst = 0;
    int between = 0;
    each_hit(scene, frame, [&](int x, int y) {
        const double h = 1e-3;
        const auto texels = [&](double dx, double dy) {
            const Vec2<double> a = uv(x + 0.5 - dx, y + 0.5 - dy),
                               b = uv(x + 0.5 + dx, y + 0.5 + dy);
            return std::hypot(b.x - a.x, b.y - a.y) / (2 * h) * 1024;
        };
        const double expected =
            std::clamp(std::log2(std::max(texels(h, 0), texels(0, h))), 0.0, 10.0);
        const double level = frame.base_color[0].at(x, y) * 65535 / 4096;
        worst = std::max(worst, std::abs(level - expected));
        between += expected > 0.1 && expected < 9.9;
    });
    CHECK(between > 5000);
    CHECK(worst < 2e-3);
}

TEST_CASE("texture coordinates are perspective-correct and rows run down from v = 1") {
    // One texel per channel step: red rises with u, green with the row from the top.
    Texture ramp;
    constexpr int n = 64;
    ramp.levels.push_back({n, n, 0});
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            ramp.texels.push_back(x * 1000 | y * 1000 << 16);
            ramp.texels.push_back(0 | 65535u << 16);
        }
    TestScene scene(kSize, kSize, front_camera());
    scene.textures.push_back(ramp);
    scene.materials[0].base_color_map = 0;
    scene.materials[0].base_color = {1, 1, 1};
    scene.add(grid(1, 1), {0}, {{1, 0, 0}, {0, 0.8f, 0.6f}, {0, -0.6f, 0.8f}, {0, 0, 0}});
    const Frame frame = render(scene);
    int checked = 0;
    each_hit(scene, frame, [&](int x, int y) {
        const Vec3f p = frame.at(frame.position, x, y);
        const float u = (p.x + 1) / 2;
        const float v = (p.y * 0.8f + p.z * 0.6f + 1) / 2;
        const float column = u * n - 0.5f, row = (1 - v) * n - 0.5f;
        if (column < 1 || row < 1 || column > n - 2 || row > n - 2) return;  // repeats
        ++checked;
        REQUIRE(frame.base_color[0].at(x, y) * 65.535f == doctest::Approx(column).epsilon(2e-3));
        REQUIRE(frame.base_color[1].at(x, y) * 65.535f == doctest::Approx(row).epsilon(2e-3));
    });
    CHECK(checked > 1000);
}

TEST_CASE("a cutout is open exactly where the shadow rays' test says so") {
    TestScene scene(kSize, kSize, front_camera());
    scene.textures.push_back(random_alpha(24, 10));
    scene.materials.resize(2);
    scene.materials[1].opacity_map = 0;
    Mesh screen = grid(3, 2, 0.9f);
    for (Vec2f& uv : screen.uvs) uv = uv * 2.7f - Vec2f{0.4f, 0.9f};  // repeats
    scene.add(std::move(screen), {1}, {{1, 0, 0.2f}, {0, 1, 0.1f}, {-0.2f, 0, 1}, {0, 0, 0}});
    TestScene whole(kSize, kSize, front_camera());
    whole.add(scene.meshes[0], {0}, scene.view.instances[0].world_from_object);
    const Frame frame = render(scene), uncut = render(whole);
    const CutoutMap map{reinterpret_cast<const std::int32_t*>(scene.textures[0].texels.data()), 24,
                        10};
    const Instance& instance = scene.view.instances[0];
    int open = 0, closed = 0;
    each_hit(whole, uncut, [&](int x, int y) {
        const Triangle& t = instance.mesh->triangles[uncut.triangle.at(x, y)];
        Vec2f uv[3];
        for (int k = 0; k < 3; ++k) uv[k] = instance.mesh->uvs[t.vertex[k]];
        const Camera& camera = scene.view.camera;
        const bool opaque = is_opaque(
            map,
            relative_triangle(camera.eye, instance.positions[t.vertex[0]],
                              instance.positions[t.vertex[1]], instance.positions[t.vertex[2]]),
            uv, camera.direction(x + 0.5f, y + 0.5f));
        REQUIRE((frame.instance.at(x, y) == 0) == opaque);
        ++(opaque ? closed : open);
    });
    CHECK(open > 1000);
    CHECK(closed > 1000);
}

TEST_CASE("faces emit to the side from which their vertices run counter-clockwise") {
    for (const bool mirrored : {false, true})
        for (const float side : {1.0f, -1.0f}) {
            TestScene scene(kSize, kSize, look_at({0, 0, 2 * side}, {0, 0, 0}, kSize, kSize));
            scene.materials[0].emission = {1, 2, 3};
            Affine3f map;
            if (mirrored) map.column_x = {-1, 0, 0};
            scene.add(grid(2, 2), {0}, map).flips_winding = mirrored;
            const Frame frame = render(scene);
            // In object space the square emits along +z, and mirroring x does not change that.
            CHECK(frame.emission[1].at(kSize / 2, kSize / 2) == (side > 0 ? 2 : 0));
        }
}

TEST_CASE("where nothing is hit the planes hold what the contract says") {
    TestScene scene(80, 70, look_at({0, 0, 2}, {0, 0, 5}, 80, 70));
    scene.add(sphere(10, 8));  // behind the camera
    scene.view.background = {0.25f, 0.5f, 0.75f};
    const Frame frame = render(scene);
    for (int y = 0; y < 70; ++y)
        for (int x = 0; x < 80; ++x) {
            REQUIRE(frame.instance.at(x, y) == kNothing);
            REQUIRE(frame.material.at(x, y) == kNothing);
            REQUIRE(frame.depth.at(x, y) == kDepthOfNothing);
            REQUIRE(frame.emission[2].at(x, y) == 0.75f);
            REQUIRE(frame.roughness.at(x, y) == 0);
            REQUIRE(length(frame.at(frame.normal, x, y)) == 0);
        }
}

TEST_CASE("materials reach their pixels, with roughness at least the minimum") {
    TestScene scene(kSize, kSize, front_camera());
    scene.materials.resize(2);
    scene.materials[1].base_color = {0.1f, 0.2f, 0.3f};
    scene.materials[1].roughness = 0;
    scene.materials[1].metallic = 0.75f;
    scene.materials[1].ior = 2;
    Mesh halves = grid(8, 1);
    for (std::size_t k = 0; k < halves.triangle_slots.size(); ++k)
        halves.triangle_slots[k] = k < 8 ? 0 : 1;
    scene.add(std::move(halves), {0, 1});
    const Frame frame = render(scene);
    const int y = kSize / 2;
    CHECK(frame.material.at(kSize / 4 + 6, y) == 0);
    CHECK(frame.roughness.at(kSize / 4 + 6, y) == 0.5f);
    const int right = kSize * 3 / 4 - 6;
    CHECK(frame.material.at(right, y) == 1);
    CHECK(frame.roughness.at(right, y) == kMinimumRoughness);
    CHECK(frame.metallic.at(right, y) == 0.75f);
    CHECK(frame.dielectric_f0.at(right, y) == doctest::Approx(1.0 / 9));
    CHECK(frame.base_color[2].at(right, y) == 0.3f);
}

TEST_CASE("shadow rays start on flat surfaces, and above coarse smooth ones on the viewer's side") {
    TestScene flat(kSize, kSize, front_camera());
    flat.add(grid(3, 3));
    const Frame plane = render(flat);
    each_hit(flat, plane, [&](int x, int y) {
        REQUIRE(length(plane.at(plane.shadow_origin, x, y) - plane.at(plane.position, x, y)) == 0);
    });

    TestScene scene(200, 150, look_at({0.3f, 1, 3}, {0, 0, 0}, 200, 150));
    scene.add(sphere(12, 8));
    const Frame frame = render(scene);
    float highest = 0;
    each_hit(scene, frame, [&](int x, int y) {
        const Vec3f p = frame.at(frame.position, x, y);
        const Vec3f s = frame.at(frame.shadow_origin, x, y);
        REQUIRE(dot(s - p, frame.at(frame.geometric_normal, x, y)) > -1e-6f);
        // The facet lies inside the unit sphere, and every tangent plane outside of it.
        REQUIRE(length(s) >= length(p) - 1e-6f);
        highest = std::max(highest, length(s));
    });
    CHECK(highest > 1);
    CHECK(highest < 1.2f);
}

TEST_CASE("planes that are not wanted stay untouched and change nothing else") {
    TestScene scene(64, 64, look_at({0.3f, 1, 3}, {0, 0, 0}, 64, 64));
    scene.add(torus(30, 20));
    const Frame all = render(scene);
    Frame some(64, 64);
    const parallel::Arena arena(1);
    Geometry geometry;
    prepare(scene.view, scene.frame(), scene.all_pixels(), arena, geometry);
    const auto scratch = std::make_unique<Scratch>();
    rasterize(scene.view, geometry, {}, simd::best_isa(), *scratch, some.visibility());
    SurfaceView wanted{};
    wanted.depth = some.depth.view();
    wanted.normal = view(some.normal);
    resolve(scene.view, geometry, scene.frame(), {}, some.visibility(), wanted);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            REQUIRE(some.depth.at(x, y) == all.depth.at(x, y));
            REQUIRE(some.normal[1].at(x, y) == all.normal[1].at(x, y));
        }
}
