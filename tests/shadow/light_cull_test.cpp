#include <doctest/doctest.h>

#include <algorithm>

#include "core/light/polygon.h"
#include "shadow/light_bounds.h"
#include "tests/shadow/light_testing.h"

using namespace penumbra;
using namespace penumbra::light_testing;

namespace {

std::vector<std::uint32_t> kept_lights(const SceneView& scene, const TilePlanes& tile,
                                       float tolerance, simd::Isa isa = simd::best_isa()) {
    shadow::TileLights kept;
    shadow::cull_lights(scene, {.isa = isa}, tile.const_surface(), tolerance, kept);
    return {kept.kept().begin(), kept.kept().end()};
}

double unshadowed(const TilePlanes& tile, int x, int y) {
    return luminance(TilePlanes::get(tile.diffuse, x, y) + TilePlanes::get(tile.glossy, x, y));
}

using Luminances = std::vector<double>;

Luminances shade_with(const SceneView& scene, float tolerance, TilePlanes& tile) {
    const FrameContext context{.isa = simd::best_isa()};
    shadow::TileLights kept;
    shadow::cull_lights(scene, context, tile.const_surface(), tolerance, kept);
    shadow::shade(scene, kept, LobeAccuracy::kExact, context, tile.const_surface(), tile.sums());
    Luminances values;
    for (int i = 0; i < kTileSize * kTileSize; ++i)
        values.push_back(unshadowed(tile, i % kTileSize, i / kTileSize));
    return values;
}

// The largest of (U of all lights - U of kept lights) / U of kept lights over the tile.
double largest_loss(const Luminances& all, const Luminances& kept) {
    double loss = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double lost = all[i] - kept[i];
        if (lost > 1e-6 * kept[i]) loss = std::max(loss, kept[i] > 0 ? lost / kept[i] : 1e9);
    }
    return loss;
}

}  // namespace

TEST_CASE("culled lights add up to at most the tolerance at every pixel" *
          doctest::test_suite("statistics")) {
    reference::Random random(41);
    TilePlanes tile;
    std::size_t kept = 0, total = 0;
    for (const auto& [landscape, size] : {std::pair{Landscape::kFloor, 0.05},
                                          {Landscape::kFloor, 30.0},
                                          {Landscape::kBumps, 1.0},
                                          {Landscape::kChaos, 0.2}}) {
        const SceneView scene = random_lights(random, 300, 1);
        fill_tile(random, landscape, size, tile);
        const Luminances all = shade_with(scene, 0, tile);
        for (const float tolerance : {1.0f / 1024, 1.0f / 16}) {
            CHECK(largest_loss(all, shade_with(scene, tolerance, tile)) <= tolerance);
            kept += kept_lights(scene, tile, tolerance).size();
            total += scene.lights.size();
        }
    }
    MESSAGE("kept " << kept << " of " << total);
    CHECK(kept < total);
}

TEST_CASE("one bright light near a small patch of floor makes hundreds of dim ones disappear") {
    reference::Random random(42);
    SceneView scene;
    for (int i = 0; i < 300; ++i) {
        const Vec3d center =
            Vec3d{random.uniform(-50, 50), random.uniform(20, 50), random.uniform(-50, 50)};
        scene.lights.add(
            make_light(reference::ellipse_polygon(random, center, {0.02, 0, 0}, {0, 0, 0.02}),
                       {1, 1, 1}, true));
    }
    scene.lights.add(
        make_light({{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}}, {10, 10, 10}, true));
    scene.camera.eye = {0, 1.5f, 3};
    TilePlanes tile;
    fill_tile(random, Landscape::kFloor, 0.2, tile);
    const std::vector<std::uint32_t> kept = kept_lights(scene, tile, 1.0f / 1024);
    CHECK(kept.size() < 30);
    CHECK(std::find(kept.begin(), kept.end(), 300u) != kept.end());
    const Luminances all = shade_with(scene, 0, tile);
    CHECK(largest_loss(all, shade_with(scene, 1.0f / 1024, tile)) <= 1.0 / 1024);
}

TEST_CASE("small lights that mirror in a polished floor are kept, however little they light it") {
    reference::Random random(46);
    SceneView scene;
    for (int i = 0; i < 100; ++i) {
        const Vec3d center = {random.uniform(-1, 1), 2, random.uniform(-3, -2)};
        scene.lights.add(
            make_light(reference::ellipse_polygon(random, center, {0.004, 0, 0}, {0, 0.004, 0}),
                       {3, 3, 3}, true));
    }
    scene.lights.add(
        make_light({{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}}, {10, 10, 10}, true));
    scene.camera.eye = {0, 2, 2.5f};  // sees the small lights mirrored around the origin
    TilePlanes tile;
    fill_tile(random, Landscape::kFloor, 0.2, tile);
    tile.roughness.fill(0.06f);
    const Luminances all = shade_with(scene, 0, tile);
    CHECK(largest_loss(all, shade_with(scene, 1.0f / 1024, tile)) <= 1.0 / 1024);
    CHECK(kept_lights(scene, tile, 1.0f / 1024).size() > 50);
}

TEST_CASE("it is the sum of the culled lights that stays below the tolerance") {
    reference::Random random(47);
    SceneView scene;
    const reference::Points place = {
        {-0.01, 2, -0.01}, {0.01, 2, -0.01}, {0.01, 2, 0.01}, {-0.01, 2, 0.01}};
    scene.lights.add(make_light(place, {1600, 1600, 1600}, true));
    for (int i = 0; i < 20; ++i) scene.lights.add(make_light(place, {20, 20, 20}, true));
    scene.camera.eye = {0, 2, 2};
    TilePlanes tile;
    fill_tile(random, Landscape::kFloor, 0.01, tile);
    tile.roughness.fill(1);
    tile.dielectric_f0.fill(0);
    for (Plane<float>& plane : tile.base_color) plane.fill(0.9f);
    // Each adds 1/80 of the bright one: five are less than 1/16 of what is left, and six are not.
    const std::size_t culled = 21 - kept_lights(scene, tile, 1.0f / 16).size();
    CHECK(culled >= 2);
    CHECK(culled <= 5);
}

TEST_CASE("a tolerance of zero keeps every light, and the kept ones are in ascending order") {
    reference::Random random(43);
    const SceneView scene = random_lights(random, 100, 1);
    TilePlanes tile;
    fill_tile(random, Landscape::kBumps, 1, tile);
    CHECK(kept_lights(scene, tile, 0).size() == 100);
    const std::vector<std::uint32_t> kept = kept_lights(scene, tile, 1.0f / 64);
    CHECK(kept.size() < 100);
    CHECK(std::is_sorted(kept.begin(), kept.end()));
}

TEST_CASE("the choice of lights does not depend on the instruction set") {
    reference::Random random(44);
    TilePlanes tile;
    for (int trial = 0; trial < 5; ++trial) {
        const SceneView scene = random_lights(random, 200, 1);
        fill_tile(random, Landscape::kBumps, 0.5, tile);
        const std::vector<std::uint32_t> expected = kept_lights(scene, tile, 1.0f / 256);
        for (const simd::Isa isa : instruction_sets())
            CHECK(kept_lights(scene, tile, 1.0f / 256, isa) == expected);
    }
}

TEST_CASE("bounds of a form factor hold for points and normals anywhere in their balls") {
    reference::Random random(45);
    for (int trial = 0; trial < 3000; ++trial) {
        const double reach = std::exp(random.uniform(-5, 0)),
                     bend = std::exp(random.uniform(-5, 0));
        const reference::Configuration c =
            reference::random_configuration(random, random.uniform(0.01, 2));
        const PolygonLight light = make_light(c.polygon, {1, 1, 1}, trial % 2 == 0);
        const PolygonShape<float>& shape = light.shape;
        const shadow::SurfaceBall<float> ball{to_float(c.point), static_cast<float>(reach),
                                              to_float(c.normal), static_cast<float>(bend)};
        const auto bounds = shadow::bound_form_factor(ball, shape);
        for (int i = 0; i < 10; ++i) {
            const Vec3f point = to_float(c.point + random.direction() * (reach * 0.999));
            const Vec3d normal = normalize(c.normal + random.direction() * (bend * 0.5));
            if (length(normal - c.normal) > bend) continue;
            const Vec3f n = to_float(normal);
            const float form = lambert_form_factor(shape, see_polygon(shape, point, n), n);
            CHECK(form <= bounds.lambert_high * 1.0001f + 1e-7f);
            CHECK(form >= bounds.lambert_low * 0.9999f - 1e-7f);
        }
    }
}
