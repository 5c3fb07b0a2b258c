#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "shadow/draw_lights.h"
#include "tests/shadow/light_testing.h"

using namespace penumbra;
using namespace penumbra::light_testing;

namespace {

constexpr float kWall = 10;

// A camera at the origin that looks along -z, at a wall ten metres away.
SceneView empty_scene() {
    SceneView scene;
    scene.camera.eye = {0, 0, 0};
    scene.camera.right = {1, 0, 0};
    scene.camera.up = {0, 1, 0};
    scene.camera.forward = {0, 0, -1};
    scene.camera.focal = 64;
    scene.camera.center_x = 32;
    scene.camera.center_y = 32;
    scene.camera.near_distance = 0.1f;
    scene.previous_camera = scene.camera;
    return scene;
}

void fill_wall(TilePlanes& tile) {
    tile.depth.fill(kWall);
    tile.material.fill(3);
    tile.instance.fill(4);
    tile.triangle.fill(5);
    for (Plane<float>& plane : tile.base_color) plane.fill(0.5f);
    for (Plane<float>& plane : tile.emission) plane.fill(0);
}

// A square of half-width `half` at a depth, that emits towards the camera or away from it.
PolygonLight square(float half, float depth, const Vec3f& radiance, bool towards_camera = true,
                    bool two_sided = false) {
    const double h = half, z = -depth;
    reference::Points points = {{-h, -h, z}, {h, -h, z}, {h, h, z}, {-h, h, z}};
    if (!towards_camera) std::reverse(points.begin(), points.end());
    PolygonLight light = make_light(points, radiance, two_sided);
    return light;
}

void draw(const SceneView& scene, TilePlanes& tile, const Tile& place = {},
          simd::Isa isa = simd::best_isa()) {
    shadow::draw_lights(scene, {.isa = isa}, place, tile.surface());
}

int drawn_pixels(const TilePlanes& tile) {
    int count = 0;
    for (int i = 0; i < kTileSize * kTileSize; ++i)
        count += tile.material.at(i % kTileSize, i / kTileSize) == kNothing;
    return count;
}

}  // namespace

TEST_CASE("a light in front of a wall covers exactly the pixels whose centres it contains") {
    SceneView scene = empty_scene();
    scene.lights.add(square(1, 4, {7, 8, 9}));  // 16 pixels to each side of the centre
    for (const simd::Isa isa : instruction_sets()) {
        TilePlanes tile;
        fill_wall(tile);
        draw(scene, tile, {}, isa);
        CHECK(drawn_pixels(tile) == 32 * 32);
        CHECK(tile.material.at(16, 16) == kNothing);
        CHECK(tile.material.at(47, 47) == kNothing);
        CHECK(tile.material.at(15, 20) == 3);
        CHECK(tile.material.at(48, 20) == 3);
    }
}

TEST_CASE("a drawn light is emission without a surface to shade") {
    SceneView scene = empty_scene();
    scene.lights.add(square(1, 4, {7, 8, 9}));
    TilePlanes tile;
    fill_wall(tile);
    draw(scene, tile);
    const Vec3f emission = TilePlanes::get(tile.emission, 32, 32);
    CHECK(emission.x == 7);
    CHECK(emission.y == 8);
    CHECK(emission.z == 9);
    CHECK(TilePlanes::get(tile.base_color, 32, 32).x == 0);
    CHECK(TilePlanes::get(tile.normal, 32, 32).z == 1);
    CHECK(TilePlanes::get(tile.position, 32, 32).z == doctest::Approx(-4));
    CHECK(TilePlanes::get(tile.position, 32, 32).x == doctest::Approx(4 * 0.5 / 64));
    CHECK(tile.depth.at(32, 32) == doctest::Approx(4));
    CHECK(tile.instance.at(32, 32) == kNothing);
    CHECK(tile.triangle.at(32, 32) == kNothing);
    CHECK(tile.motion_x.at(32, 32) == 0);
    CHECK(tile.emission[0].at(2, 2) == 0);
}

TEST_CASE("lights are hidden by what stands before them, by their back, and by being invisible") {
    const auto pixels = [](const PolygonLight& light) {
        SceneView scene = empty_scene();
        scene.lights.add(light);
        TilePlanes tile;
        fill_wall(tile);
        draw(scene, tile);
        return drawn_pixels(tile);
    };
    CHECK(pixels(square(1, 11, {1, 1, 1})) == 0);
    CHECK(pixels(square(1, kWall, {1, 1, 1})) > 0);       // on the wall
    CHECK(pixels(square(0.01f, 0.05f, {1, 1, 1})) == 0);  // before the near plane
    CHECK(pixels(square(1, 4, {1, 1, 1}, false)) == 0);
    CHECK(pixels(square(1, 4, {1, 1, 1}, false, true)) == 32 * 32);
    PolygonLight hidden = square(1, 4, {1, 1, 1});
    hidden.visible = false;
    CHECK(pixels(hidden) == 0);
}

TEST_CASE("the nearest of several lights is seen, whatever their order") {
    for (const bool near_first : {false, true}) {
        SceneView scene = empty_scene();
        scene.lights.add(square(1, near_first ? 4.0f : 6.0f, {near_first ? 1.0f : 2.0f, 0, 0}));
        scene.lights.add(square(1, near_first ? 6.0f : 4.0f, {near_first ? 2.0f : 1.0f, 0, 0}));
        TilePlanes tile;
        fill_wall(tile);
        draw(scene, tile);
        CHECK(tile.emission[0].at(32, 32) == 1);
    }
}

TEST_CASE("a light is drawn the same in whichever tile its pixels lie") {
    SceneView scene = empty_scene();
    scene.lights.add(square(3, 4, {1, 1, 1}));  // 96 pixels wide, from -16 to 80
    int pixels = 0;
    for (int y = -64; y <= 64; y += 64) {
        for (int x = -64; x <= 64; x += 64) {
            TilePlanes tile;
            fill_wall(tile);
            draw(scene, tile, {.x0 = x, .y0 = y, .index = 0});
            pixels += drawn_pixels(tile);
        }
    }
    CHECK(pixels == 96 * 96);
}

TEST_CASE("a light that reaches behind the camera is drawn where it is in front") {
    SceneView scene = empty_scene();
    // A ceiling one metre above, from ten metres behind the camera to the wall.
    scene.lights.add(
        make_light({{-50, 1, -10}, {50, 1, -10}, {50, 1, 10}, {-50, 1, 10}}, {1, 1, 1}, true));
    TilePlanes tile;
    fill_wall(tile);
    draw(scene, tile);
    // Above the line 64 / 10 pixels over the horizon.
    CHECK(tile.material.at(10, 0) == kNothing);
    CHECK(tile.material.at(60, 24) == kNothing);
    CHECK(tile.material.at(10, 26) == 3);
    CHECK(drawn_pixels(tile) == 64 * 26);
}

TEST_CASE("the motion of a light at rest is that of the camera") {
    SceneView scene = empty_scene();
    scene.lights.add(square(1, 4, {1, 1, 1}));
    scene.previous_camera.eye = {-0.25f, 0, 0};  // it moved right by a quarter: 4 pixels at depth 4
    TilePlanes tile;
    fill_wall(tile);
    draw(scene, tile);
    CHECK(tile.motion_x.at(30, 30) == doctest::Approx(-4));
    CHECK(tile.motion_y.at(30, 30) == doctest::Approx(0));
}
