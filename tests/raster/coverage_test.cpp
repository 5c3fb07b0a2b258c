#include <doctest/doctest.h>

#include <algorithm>

#include "tests/raster/scenes.h"

// Every pixel once: counted with all triangles, hidden ones too. For a closed mesh the sum over
// front faces minus that over back faces is 0 at every pixel; a gap or a pixel covered twice along
// any edge breaks it.

using namespace penumbra;
using namespace penumbra::raster;
using namespace penumbra::raster::testing;

namespace {

struct Balance {
    int covered = 0;     // pixels
    int unbalanced = 0;  // pixels with unequal fronts and backs
    int most = 0;        // fronts of one pixel
};
Balance balance(TestScene& scene) {
    Balance result;
    for (const simd::Isa isa : {simd::Isa::kAvx2, simd::best_isa()}) {
        const Coverage c = count(scene, isa);
        for (int y = 0; y < scene.height; ++y)
            for (int x = 0; x < scene.width; ++x) {
                const int front = c.front.at(x, y);
                result.unbalanced += front != c.back.at(x, y);
                result.covered += front > 0;
                result.most = std::max(result.most, front);
            }
    }
    return result;
}

// Moves every vertex, equal positions equally, by up to `amount`.
void shake(Mesh& mesh, std::uint32_t seed, float amount) {
    for (Vec3f& p : mesh.positions) {
        std::seed_seq key{seed, simd::as_uint(p.x), simd::as_uint(p.y), simd::as_uint(p.z)};
        std::mt19937 random(key);
        const auto step = [&] {
            return amount * (static_cast<float>(random() >> 8) * 0x1p-23f - 1);
        };
        const float dx = step();
        const float dy = step();
        const float dz = step();
        p += Vec3f{dx, dy, dz};
    }
    mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
}

// A camera whose view-space x and y are world x and -y in pixels at z = 1: the image plane itself.
Camera pixel_camera() {
    Camera camera;
    camera.eye = {0, 0, 0};
    camera.right = {1, 0, 0};
    camera.up = {0, -1, 0};
    camera.forward = {0, 0, 1};
    camera.near_distance = 0.5f;
    return camera;
}

// How many pixels of a frame are not covered exactly once, front and back together.
int not_once(TestScene& scene, const PixelRect& inside) {
    const Coverage c = count(scene);
    int wrong = 0;
    for (int y = inside.y0; y < inside.y1; ++y)
        for (int x = inside.x0; x < inside.x1; ++x)
            wrong += c.front.at(x, y) + c.back.at(x, y) != 1;
    return wrong;
}

}  // namespace

TEST_CASE("a closed mesh covers every pixel as often from the front as from the back") {
    TestScene scene(200, 150, look_at({0, 1, 3.5f}, {0, 0, 0}, 200, 150));
    scene.add(torus(40, 20));
    const Balance b = balance(scene);
    CHECK(b.unbalanced == 0);
    CHECK(b.covered > 2 * 5000);
}

TEST_CASE("a convex closed mesh covers a pixel from the front once or not at all") {
    TestScene scene(200, 150, look_at({0.3f, 1, 3.5f}, {0, 0, 0}, 200, 150));
    scene.add(sphere(64, 40));
    const Balance b = balance(scene);
    CHECK(b.unbalanced == 0);
    CHECK(b.most == 1);
}

TEST_CASE("random closed meshes have neither gaps nor double cover") {
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        TestScene scene(160, 128, look_at({0.2f, 0.7f, 3}, {0, 0, 0}, 160, 128));
        Mesh mesh = seed % 2 ? torus(9 + seed, 7) : sphere(60 * seed, 30);
        shake(mesh, seed, 0.3f);
        scene.add(std::move(mesh));
        const Balance b = balance(scene);
        CAPTURE(seed);
        CHECK(b.unbalanced == 0);
        CHECK(b.covered > 1000);
    }
}

TEST_CASE("closed meshes around the camera are clipped without gaps beside the near plane") {
    // The camera is inside: every pixel sees the mesh's back exactly once more than its front.
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        TestScene scene(160, 128, look_at({0.1f, 0.05f, 0.2f}, {1, 0.2f, 0.3f}, 160, 128, 100));
        Mesh mesh = sphere(12 * seed, 8 * seed);
        shake(mesh, seed, 0.1f);
        scene.add(std::move(mesh));
        scene.view.camera.near_distance = 0.001f;
        const Coverage c = count(scene);
        int wrong = 0;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 160; ++x)
                wrong += std::abs(c.back.at(x, y) - c.front.at(x, y)) != 1;
        CAPTURE(seed);
        CHECK(wrong == 0);
    }
}

TEST_CASE("triangles that reach far outside the guard band share their clipped edges") {
    // A large shaken plane close below the eye, up to its horizon: most triangles cross planes.
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        TestScene scene(192, 128, look_at({0.3f, 0.2f, 0.1f}, {0.35f, -0.8f, 0.15f}, 192, 128, 90));
        Mesh mesh = grid(7, 5, 1e4f);
        for (Vec3f& p : mesh.positions) p = {p.x, 0, -p.y};
        std::mt19937 random(seed);
        for (Vec3f& p : mesh.positions) {
            p.x += static_cast<float>(random() % 1000);
            p.z += static_cast<float>(random() % 1000);
        }
        scene.add(std::move(mesh));
        scene.view.camera.near_distance = 1e-4f;
        CAPTURE(seed);
        CHECK(not_once(scene, {0, 0, 192, 128}) == 0);
    }
}

TEST_CASE("a fan of slivers around a point tiles the plane") {
    for (const int spokes : {3, 17, 500, 4000}) {
        TestScene scene(256, 192, pixel_camera());
        Mesh mesh;
        const std::uint32_t center = add_vertex(mesh, {127.3f, 96.8f, 1});
        for (int k = 0; k < spokes; ++k) {
            const double angle = 2 * M_PI * k / spokes;
            add_vertex(mesh, {static_cast<float>(127.3 + 900 * std::cos(angle)),
                              static_cast<float>(96.8 + 900 * std::sin(angle)), 1});
        }
        for (int k = 0; k < spokes; ++k) add_triangle(mesh, center, 1 + k, 1 + (k + 1) % spokes);
        scene.add(std::move(mesh));
        CAPTURE(spokes);
        CHECK(not_once(scene, {0, 0, 256, 192}) == 0);
    }
}

TEST_CASE("edges through pixel centres belong to one side") {
    // Vertices on multiples of half a pixel: nearly every edge passes through centres.
    TestScene scene(128, 128, pixel_camera());
    Mesh mesh = parametric(45, 45, [](int i, int j, Vec2f) {
        return Placed{{0.5f + 2.5f * static_cast<float>(i), 0.5f + 2.5f * static_cast<float>(j), 1},
                      {0, 0, 1}};
    });
    scene.add(std::move(mesh));
    CHECK(not_once(scene, {1, 1, 112, 112}) == 0);
}

TEST_CASE("coordinates of 16k pixels tile as exactly as small ones") {
    TestScene scene(16384, 64, pixel_camera());
    std::mt19937 random(7);
    Mesh mesh = parametric(13, 5, [&](int i, int j, Vec2f) {
        const auto jitter = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
        const float x = static_cast<float>(i) * 1500 - 1200 + 700 * jitter();
        const float y = static_cast<float>(j) * 700 - 1700 + 300 * jitter();
        return Placed{{x, y, 1}, {0, 0, 1}};
    });
    scene.add(std::move(mesh));
    CHECK(not_once(scene, {0, 0, 16384, 64}) == 0);
}

TEST_CASE("a triangle covers what an edge test at every pixel of its own says") {
    // Independent of the rasterizer's stepping: every pixel on its own, random triangles of
    // all sizes, including sizes above and below what is set up in 32 bits.
    std::mt19937 random(11);
    for (int round = 0; round < 150; ++round) {
        TestScene scene(128, 128, pixel_camera());
        Mesh mesh;
        const float size = std::exp2(static_cast<float>(round % 15));
        std::int64_t x[3], y[3];
        for (int k = 0; k < 3; ++k) {
            const auto coordinate = [&] {
                const float pixels = 64 + size * (static_cast<float>(random() >> 8) * 0x1p-23f - 1);
                return std::nearbyint(pixels * 32) / 32;  // many hits of edges and vertices
            };
            const float px = coordinate();
            const float py = coordinate();
            add_vertex(mesh, {px, py, 1});
            x[k] = std::llrint(px * 256);
            y[k] = std::llrint(py * 256);
        }
        add_triangle(mesh, 0, 1, 2);
        scene.add(std::move(mesh));
        const Coverage c = count(scene, round % 2 ? simd::Isa::kAvx2 : simd::best_isa());
        const bool is_positive = static_cast<std::int64_t>(x[1] - x[0]) * (y[2] - y[0]) >
                                 static_cast<std::int64_t>(y[1] - y[0]) * (x[2] - x[0]);
        const int order[4] = {0, is_positive ? 1 : 2, is_positive ? 2 : 1, 0};
        int wrong = 0;
        for (int j = 0; j < 128; ++j)
            for (int i = 0; i < 128; ++i) {
                bool inside = true;
                for (int k = 0; k < 3; ++k) {
                    const int a = order[k], b = order[k + 1];
                    const std::int64_t dx = x[b] - x[a], dy = y[b] - y[a];
                    const std::int64_t e = static_cast<std::int64_t>(dx) * (j * 256 + 128 - y[a]) -
                                           static_cast<std::int64_t>(dy) * (i * 256 + 128 - x[a]);
                    inside &= e > 0 || (e == 0 && (dy < 0 || (dy == 0 && dx > 0)));
                }
                wrong += (c.front.at(i, j) + c.back.at(i, j)) != (inside ? 1 : 0);
            }
        CAPTURE(round);
        CHECK(wrong == 0);
    }
}
