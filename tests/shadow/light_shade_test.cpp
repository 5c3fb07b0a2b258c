#include <doctest/doctest.h>

#include <bit>

#include "shadow/shade_point.h"
#include "tests/shadow/light_testing.h"

using namespace penumbra;
using namespace penumbra::light_testing;

namespace {

bool same_bits(const Vec3f& a, const Vec3f& b) {
    const auto bits = [](float f) { return std::bit_cast<std::uint32_t>(f); };
    return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y) && bits(a.z) == bits(b.z);
}

shadow::ShadingPoint<float> point_of(const TilePlanes& tile, const Vec3f& eye, int x, int y) {
    return {TilePlanes::get(tile.position, x, y),
            TilePlanes::get(tile.normal, x, y),
            eye,
            TilePlanes::get(tile.base_color, x, y),
            tile.roughness.at(x, y),
            tile.metallic.at(x, y),
            tile.dielectric_f0.at(x, y)};
}

// The definition: one point and one light after the other.
shadow::Unshadowed<float> shade_one(const LightSet& lights,
                                    const shadow::ShadingPoint<float>& point) {
    const shadow::ShadingLobes<float> lobes = shadow::make_lobes(point);
    shadow::ArrivingLight<float> sum;
    for (const PolygonLight& light : lights.polygons)
        shadow::add_light(light, see_polygon(light.shape, point.position, point.normal),
                          point.normal, lobes, LobeAccuracy::kExact, sum);
    return shadow::reflect(lobes, sum);
}

void shade_all(const SceneView& scene, simd::Isa isa, TilePlanes& tile) {
    const FrameContext context{.isa = isa};
    shadow::TileLights kept;
    shadow::cull_lights(scene, context, tile.const_surface(), 0, kept);
    shadow::shade(scene, kept, LobeAccuracy::kExact, context, tile.const_surface(), tile.sums());
}

}  // namespace

TEST_CASE("U has the same bits for one lane and for those of every instruction set") {
    reference::Random random(31);
    TilePlanes tile;
    for (const Landscape landscape : {Landscape::kFloor, Landscape::kBumps, Landscape::kChaos}) {
        fill_tile(random, landscape, 1, tile);
        const SceneView scene = random_lights(random, 12, 1);
        for (const simd::Isa isa : instruction_sets()) {
            shade_all(scene, isa, tile);
            int different = 0;
            for (int y = 0; y < kTileSize; ++y) {
                for (int x = 0; x < kTileSize; ++x) {
                    shadow::Unshadowed<float> expected;
                    if (tile.material.at(x, y) != kNothing)
                        expected = shade_one(scene.lights, point_of(tile, scene.camera.eye, x, y));
                    if (!same_bits(TilePlanes::get(tile.diffuse, x, y), expected.diffuse) ||
                        !same_bits(TilePlanes::get(tile.glossy, x, y), expected.glossy))
                        ++different;
                }
            }
            CAPTURE(simd::name(isa));
            CHECK(different == 0);
        }
    }
}

TEST_CASE("diffuse U is the albedo times the light of the textbook") {
    reference::Random random(32);
    for (int trial = 0; trial < 200; ++trial) {
        const reference::Configuration c =
            reference::random_configuration(random, random.uniform(0.05, 2));
        const Vec3f radiance{5, 1, 0.25f};
        const PolygonLight light = make_light(c.polygon, radiance, true);
        const Vec3d eye = c.point + c.normal + random.direction() * 0.5;
        const shadow::ShadingPoint<float> point{to_float(c.point),
                                                to_float(c.normal),
                                                to_float(eye),
                                                {0.8f, 0.5f, 0.2f},
                                                0.5f,
                                                0.25f,
                                                0.04f};
        const Vec3f diffuse = shadow::unshadowed_light(light, point).diffuse;
        const double form = reference::lambert_form_factor(c.polygon, c.point, c.normal);
        CHECK(diffuse.x == doctest::Approx(0.8 * 0.75 * 5 * form).epsilon(2e-4).scale(1e-2));
        CHECK(diffuse.y == doctest::Approx(0.5 * 0.75 * 1 * form).epsilon(2e-4).scale(1e-2));
        CHECK(diffuse.z == doctest::Approx(0.2 * 0.75 * 0.25 * form).epsilon(2e-4).scale(1e-2));
    }
}

TEST_CASE("under a light that fills the hemisphere a surface shows its albedo") {
    const Vec3f corners[4] = {
        {-1e4f, 0.1f, -1e4f}, {1e4f, 0.1f, -1e4f}, {1e4f, 0.1f, 1e4f}, {-1e4f, 0.1f, 1e4f}};
    PolygonLight lamp;
    lamp.shape = make_polygon_shape(corners, 4, false);
    lamp.emission.radiance = {1, 1, 1};
    REQUIRE(lamp.shape.normal.y == -1);
    for (const float roughness : {0.05f, 0.2f, 0.5f, 1.0f}) {
        for (const float tilt : {0.0f, 0.5f, 0.9f}) {
            const shadow::ShadingPoint<float> point{
                {0, 0, 0}, {0, 1, 0}, {tilt, 1, 0.3f * tilt}, {0.8f, 0.5f, 0.2f}, roughness,
                0,         0.04f};
            const auto light = shadow::unshadowed_light(lamp, point);
            CHECK(light.diffuse.x == doctest::Approx(0.8).epsilon(1e-4));
            const Vec3f view = normalize(point.eye);
            const LtcEntry<float> entry = ltc_lookup(roughness, view.y);
            const Vec3f albedo = ltc_specular_albedo(entry, Vec3f{0.04f, 0.04f, 0.04f});
            CHECK(light.glossy.x == doctest::Approx(albedo.x).epsilon(2e-3));
        }
    }
}

TEST_CASE("pixels where nothing is hit get no light, whatever their planes hold") {
    reference::Random random(33);
    TilePlanes tile;
    fill_tile(random, Landscape::kChaos, 1, tile);
    const SceneView scene = random_lights(random, 4, 1);
    tile.material.fill(kNothing);
    for (Plane<float>& plane : tile.normal) plane.fill(0);
    for (Plane<float>& plane : tile.diffuse) plane.fill(7);
    shade_all(scene, simd::best_isa(), tile);
    for (int i = 0; i < kTileSize; ++i) {
        CHECK(same_bits(TilePlanes::get(tile.diffuse, i, 63 - i), {0, 0, 0}));
        CHECK(same_bits(TilePlanes::get(tile.glossy, i, 63 - i), {0, 0, 0}));
    }
}

TEST_CASE("a light without a shape gives nothing") {
    SceneView scene;
    PolygonLight flat;
    flat.emission.radiance = {5, 5, 5};
    scene.lights.add(flat);
    reference::Random random(34);
    TilePlanes tile;
    fill_tile(random, Landscape::kBumps, 1, tile);
    shade_all(scene, simd::best_isa(), tile);
    CHECK(same_bits(TilePlanes::get(tile.diffuse, 5, 5), {0, 0, 0}));
    CHECK(same_bits(TilePlanes::get(tile.glossy, 5, 5), {0, 0, 0}));
}
