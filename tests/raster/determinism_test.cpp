#include <doctest/doctest.h>

#include <cstring>

#include "tests/raster/scenes.h"

using namespace penumbra;
using namespace penumbra::raster;
using namespace penumbra::raster::testing;

namespace {

// Bits of a window of every plane, in order.
std::vector<std::uint32_t> bits(const Frame& frame, const PixelRect& window) {
    std::vector<std::uint32_t> all;
    frame.each_plane([&](const auto& plane) {
        for (int y = window.y0; y < window.y1; ++y) {
            const std::size_t begin = all.size();
            all.resize(begin + static_cast<std::size_t>(window.width()));
            std::memcpy(all.data() + begin, plane.row(y) + window.x0,
                        static_cast<std::size_t>(window.width()) * 4);
        }
    });
    return all;
}

Texture noise_texture(int width, int height) {
    Texture texture;
    std::mt19937 random(3);
    for (int w = width, h = height;; w = std::max(1, w / 2), h = std::max(1, h / 2)) {
        texture.levels.push_back({w, h, static_cast<std::int32_t>(texture.texels.size())});
        for (int k = 0; k < 2 * w * h; ++k)
            texture.texels.push_back(static_cast<std::uint32_t>(random()));
        if (w == 1 && h == 1) return texture;
    }
}

// Everything at once: several meshes and materials, all maps, cutouts, clipped and huge triangles.
void build(TestScene& scene) {
    scene.textures.push_back(noise_texture(64, 32));
    scene.materials.resize(3);
    scene.materials[1].base_color_map = scene.materials[1].roughness_map = 0;
    scene.materials[1].metallic_map = scene.materials[1].normal_map = 0;
    scene.materials[1].emission = {1, 2, 3};
    scene.materials[2].opacity_map = 0;
    scene.view.background = {0.1f, 0.2f, 0.3f};
    Mesh mixed = torus(60, 30);
    for (std::size_t k = 0; k < mixed.triangle_slots.size(); ++k)
        mixed.triangle_slots[k] = static_cast<std::uint16_t>(k / 7 % 3);
    scene.add(std::move(mixed), {0, 1, 2});
    scene.add(soup({.seed = 5, .count = 6000, .spread = 2, .smallest = 1e-4f, .largest = 3}), {1});
    scene.add(sphere(300, 200, {0, 0.8f, 0}, 0.5f), {0});
    Affine3f moved;
    moved.translation = {0.01f, 0.02f, -0.03f};
    scene.view.instances[1].previous_from_current = moved;
}

constexpr int kWidth = 333, kHeight = 217;
Camera camera() {
    return look_at({0.2f, 0.9f, 2.8f}, {0, 0, 0}, kWidth, kHeight);
}

}  // namespace

TEST_CASE("the G-buffer has the same bits for 8 and 16 lanes") {
    if (!simd::is_supported(simd::Isa::kAvx512)) return;
    TestScene scene(kWidth, kHeight, camera());
    build(scene);
    const parallel::Arena arena(1);
    const Frame narrow = render(scene, arena, simd::Isa::kAvx2, scene.all_pixels());
    const Frame wide = render(scene, arena, simd::Isa::kAvx512, scene.all_pixels());
    CHECK(bits(narrow, scene.all_pixels()) == bits(wide, scene.all_pixels()));
}

TEST_CASE("the G-buffer does not depend on the number of threads") {
    TestScene scene(kWidth, kHeight, camera());
    build(scene);
    const auto expected = bits(render(scene), scene.all_pixels());
    for (const int threads : {2, 3, 7}) {
        const parallel::Arena arena(threads);
        CAPTURE(threads);
        const Frame frame = render(scene, arena, simd::best_isa(), scene.all_pixels());
        CHECK(bits(frame, scene.all_pixels()) == expected);
    }
}

TEST_CASE("a crop is that cut-out of the full frame") {
    TestScene scene(kWidth, kHeight, camera());
    build(scene);
    const Frame full = render(scene);
    const parallel::Arena arena(2);
    for (const PixelRect& window :
         {PixelRect{0, 0, 1, 1}, PixelRect{100, 60, 250, 131}, PixelRect{64, 128, 128, 192},
          PixelRect{300, 200, kWidth, kHeight}}) {
        const Frame crop = render(scene, arena, simd::best_isa(), window);
        CHECK(bits(crop, window) == bits(full, window));
    }
}

TEST_CASE("geometry that is prepared again forgets the frame before") {
    TestScene first(kWidth, kHeight, camera());
    build(first);
    TestScene second(kWidth, kHeight, camera());
    second.add(sphere(50, 30));
    const parallel::Arena arena(1);
    Geometry reused, fresh;
    prepare(first.finish(), first.frame(), first.all_pixels(), arena, reused);
    prepare(second.finish(), second.frame(), second.all_pixels(), arena, reused);
    prepare(second.finish(), second.frame(), second.all_pixels(), arena, fresh);
    REQUIRE(reused.chunks.size() == fresh.chunks.size());
    for (std::size_t k = 0; k < fresh.chunks.size(); ++k)
        CHECK(reused.chunks[k].references == fresh.chunks[k].references);
    CHECK(reused.bins.first == fresh.bins.first);
}

TEST_CASE("every value of the G-buffer is finite, whatever the triangles") {
    TestScene scene(kWidth, kHeight, camera());
    build(scene);
    scene.add(soup({.seed = 9, .count = 500, .spread = 3, .smallest = 1e-7f, .largest = 1e4f}),
              {1});
    Mesh edge_on;  // seen exactly from its side
    add_vertex(edge_on, scene.view.camera.eye + scene.view.camera.forward);
    add_vertex(edge_on, scene.view.camera.eye + scene.view.camera.forward * 2.0f);
    add_vertex(edge_on, scene.view.camera.eye + scene.view.camera.forward * 2.0f +
                            scene.view.camera.right * 0.5f);
    add_triangle(edge_on, 0, 1, 2);
    scene.add(std::move(edge_on), {1});
    const Frame frame = render(scene);
    int wrong = 0;
    frame.each_plane([&](const auto& plane) {
        if constexpr (std::is_same_v<std::decay_t<decltype(plane)>, Plane<float>>)
            for (int y = 0; y < kHeight; ++y)
                for (int x = 0; x < kWidth; ++x) wrong += !std::isfinite(plane.at(x, y));
    });
    CHECK(wrong == 0);
}

TEST_CASE("a triangle of a large mesh costs few bytes of state") {
    TestScene scene(640, 360, look_at({0, 0, 2.4f}, {0, 0, 0}, 640, 360));
    scene.add(grid(600, 500));
    const parallel::Arena arena(1);
    Geometry geometry;
    prepare(scene.finish(), scene.frame(), scene.all_pixels(), arena, geometry);
    const double per_triangle = static_cast<double>(allocated_bytes(geometry)) / 600000;
    MESSAGE("state: " << per_triangle << " bytes per triangle");
    CHECK(per_triangle < 16);
}
