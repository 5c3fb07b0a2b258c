#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "core/bsdf/ggx.h"
#include "core/light/polygon.h"
#include "core/math/frame.h"
#include "tests/shadow/rays_scene.h"

// Mean(U_N) and mean(S_N) over many independent sequences against a cubature in double precision
// with a ray-triangle test of its own.

namespace penumbra::shadow {
namespace {

Vec3d to_double(const Vec3f& v) {
    return {v.x, v.y, v.z};
}

struct Reference {
    Vec3d shadowed{0, 0, 0}, unshadowed{0, 0, 0}, diffuse{0, 0, 0};
};

// Moeller and Trumbore's test, on the segment from a to b.
bool blocks(const Vec3d (&t)[3], const Vec3d& a, const Vec3d& b) {
    const Vec3d direction = b - a, e1 = t[1] - t[0], e2 = t[2] - t[0];
    const Vec3d p = cross(direction, e2);
    const double determinant = dot(e1, p);
    if (determinant == 0) return false;
    const Vec3d s = a - t[0];
    const double u = dot(s, p) / determinant;
    const Vec3d q = cross(s, e1);
    const double v = dot(direction, q) / determinant;
    const double along = dot(e2, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && along > 1e-6 && along < 1 - 1e-6;
}

bool is_blocked(const SceneView& view, const Vec3d& a, const Vec3d& b) {
    for (const Instance& instance : view.instances)
        for (const Triangle& triangle : instance.mesh->triangles) {
            const Vec3d corners[3] = {to_double(instance.positions[triangle.vertex[0]]),
                                      to_double(instance.positions[triangle.vertex[1]]),
                                      to_double(instance.positions[triangle.vertex[2]])};
            if (blocks(corners, a, b)) return true;
        }
    return false;
}

struct Integrand {
    const SurfacePoint& point;
    Vec3d eye;
    Brdf<double> brdf = make_brdf<double>(to_double(point.base_color), point.roughness,
                                          point.metallic, point.dielectric_f0);
    Frame<double> frame = frame_from_normal(to_double(point.normal));
    Vec3d view = frame.to_local(normalize(eye - to_double(point.position)));

    void add(const SceneView& scene, const Vec3d& on_light, const Vec3d& radiance_times_measure,
             Reference& sum) const {
        const Vec3d direction = frame.to_local(normalize(on_light - to_double(point.position)));
        if (direction.z <= 0) return;
        const Vec3d diffuse = lambert_times_cosine(brdf.diffuse_albedo, direction.z);
        const auto lobe = ggx_evaluate(brdf.alpha, view, direction);
        const Vec3d value =
            (diffuse + ggx_specular_times_cosine(lobe, brdf.f0)) * radiance_times_measure;
        sum.unshadowed += value;
        sum.diffuse += diffuse * radiance_times_measure;
        if (!is_blocked(scene, to_double(point.position), on_light)) sum.shadowed += value;
    }
};

Reference reference(const SceneView& scene, const PolygonLight& light, const SurfacePoint& point,
                    const Vec3f& eye) {
    constexpr int kSteps = 240;
    const Integrand integrand{point, to_double(eye)};
    Reference sum;
    const Vec3d a = to_double(light.shape.vertices[0]);
    for (int corner = 1; corner + 1 < light.shape.count; ++corner) {
        const Vec3d e1 = to_double(light.shape.vertices[corner]) - a;
        const Vec3d e2 =
            to_double(light.shape.vertices[corner + 1]) - to_double(light.shape.vertices[corner]);
        const Vec3d area = cross(e1, e2);
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const double u = (i + 0.5) / kSteps, v = (j + 0.5) / kSteps;
                const Vec3d place = a + e1 * u + e2 * (u * v);
                const Vec3d to_light = place - to_double(point.position);
                const double distance = length(to_light);
                double facing = -dot(area, to_light);
                if (light.shape.two_sided) facing = std::fabs(facing);
                if (facing <= 0) continue;
                // Of the triangle's points the share between u and u + du is 2 u du.
                const double measure = facing / (distance * distance * distance) * u /
                                       (static_cast<double>(kSteps) * kSteps);
                integrand.add(scene, place, to_double(light.emission.radiance) * measure, sum);
            }
    }
    return sum;
}

struct Estimate {
    double mean = 0, standard_error = 0;
};

// Each replicate is the mean over a tile of equal pixels: replicates are independent, pixels are
// not.
Estimate estimate(const std::vector<double>& replicates) {
    Estimate result;
    const double n = static_cast<double>(replicates.size());
    for (const double value : replicates) result.mean += value / n;
    double variance = 0;
    for (const double value : replicates) variance += std::pow(value - result.mean, 2) / (n - 1);
    result.standard_error = std::sqrt(variance / n);
    return result;
}

// The first rows of a tile: enough, and quick under sanitizers.
constexpr int kUsedPixels = 16 * kTileSize;

void fill(HandTile& tile, const SurfacePoint& point) {
    for (int pixel = 0; pixel < kUsedPixels; ++pixel) tile.set(pixel, point);
}

double tile_mean(const Plane<float>& plane) {
    double sum = 0;
    for (int pixel = 0; pixel < kUsedPixels; ++pixel)
        sum += static_cast<double>(plane.row(0)[pixel]);
    return sum / kUsedPixels;
}

struct SumsCase {
    std::string name;
    PolygonLight light;
    SurfacePoint point;
    Vec3f eye;
    int samples;
};

std::vector<SumsCase> sums_cases() {
    const PolygonLight rect = make_light({{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}});
    const PolygonLight triangle =
        make_light({{0.2f, 1.5f, 0}, {2, 1.5f, 0.3f}, {1, 2.5f, 1.5f}}, true);
    const PolygonLight standing = make_light({{1.2f, -0.5f, -0.6f},
                                              {1.21f, -0.4f, 0.7f},
                                              {1.34f, 0.9f, 0.8f},
                                              {1.39f, 1.4f, 0.1f},
                                              {1.33f, 0.8f, -0.7f}},
                                             true);
    const PolygonLight small =
        make_light({{0.5f, 1.5f, 0.5f}, {0.51f, 1.5f, 0.5f}, {0.5f, 1.5f, 0.51f}}, true);
    const SurfacePoint rough = {{0, 0, 0}, {0, 1, 0}, {0, 1, 0}};
    SurfacePoint shiny = rough;
    shiny.roughness = 0.25f;
    shiny.base_color = {0.9f, 0.5f, 0.2f};
    SurfacePoint metal = shiny;
    metal.metallic = 1;
    SurfacePoint bent = rough;
    bent.normal = normalize(Vec3f{0.3f, 0.9f, -0.1f});
    const Vec3f eye = {-1.5f, 1.4f, 0.2f};
    return {{"rect, 1 ray", rect, rough, eye, 1},
            {"rect, 4 rays", rect, shiny, eye, 4},
            {"rect, 5 rays, MIS", rect, shiny, eye, 5},
            {"rect, 20 rays, MIS", rect, shiny, eye, 20},
            {"metal, 16 rays, MIS", rect, metal, eye, 16},
            {"triangle", triangle, rough, eye, 2},
            {"cut by the horizon", standing, rough, eye, 1},
            {"cut, bent normal, MIS", standing, bent, eye, 8},
            {"small", small, rough, eye, 1}};
}

constexpr int kReplicates = 12;
// Two-sided quantile of Student's t with 11 degrees of freedom at 0.001 / (9 cases x 2 sums x 3
// channels), after Bonferroni.
constexpr double kSignificantT = 7.5;

void check_means(const SumsCase& c, const Occluders& occluders, const SceneView& view) {
    const Reference expected = reference(view, c.light, c.point, c.eye);
    HandTile tile;
    fill(tile, c.point);
    RayScratch scratch;
    TileRun run{&occluders, Visibility::kTraced, c.eye, {}};
    run.frame.isa = simd::best_isa();
    std::vector<double> shadowed[3], unshadowed[3];
    for (int replicate = 0; replicate < kReplicates; ++replicate) {
        run.frame.seed = static_cast<std::uint32_t>(replicate) + 1;
        tile.clear_sums();
        add_light(run, c.light, c.samples, tile, scratch);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            shadowed[channel].push_back(tile_mean(tile.shadowed[channel]));
            unshadowed[channel].push_back(tile_mean(tile.unshadowed[channel]));
        }
    }
    const double expected_u[3] = {expected.unshadowed.x, expected.unshadowed.y,
                                  expected.unshadowed.z};
    const double expected_s[3] = {expected.shadowed.x, expected.shadowed.y, expected.shadowed.z};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const Estimate u = estimate(unshadowed[channel]), s = estimate(shadowed[channel]);
        INFO(c.name << ", channel " << channel << ": U_N " << u.mean << " +- " << u.standard_error
                    << ", expected " << expected_u[channel] << "; S_N " << s.mean << " +- "
                    << s.standard_error << ", expected " << expected_s[channel]);
        // The cubature's own error, at edges of shadows and highlights.
        const double slack_u = 2e-5 * expected_u[channel], slack_s = 3e-4 * expected_u[channel];
        CHECK(std::fabs(u.mean - expected_u[channel]) < kSignificantT * u.standard_error + slack_u);
        CHECK(std::fabs(s.mean - expected_s[channel]) < kSignificantT * s.standard_error + slack_s);
        CHECK(u.standard_error < 3e-3 * expected_u[channel]);
        CHECK(expected_s[channel] < 0.95 * expected_u[channel]);
    }
}

}  // namespace

TEST_CASE("the means of U_N and S_N are the integrals without and with shadows") {
    HandScene scene;
    scene.add({{0.1f, 0.7f, -0.4f}, {0.9f, 0.6f, -0.5f}, {0.8f, 0.9f, 0.6f}}, {{{0, 1, 2}}});
    scene.add({{-2, 1.1f, 0.1f}, {0.2f, 1.2f, 0.1f}, {0.1f, 1.1f, 3}}, {{{0, 1, 2}}});
    scene.add({{0.6f, 0.1f, -1}, {0.65f, 0.5f, -1}, {0.5f, 0.3f, 2}}, {{{0, 1, 2}}});
    const parallel::Arena arena(1);
    Occluders occluders(arena, TraceIsa::kAvx2);
    occluders.update(scene.evaluated());
    for (const SumsCase& c : sums_cases()) {
        if (c.name == "small") continue;  // no occluder casts a penumbra there
        check_means(c, occluders, scene.view);
    }
}

TEST_CASE("the mean of U_N is the closed form where that is exact") {
    const parallel::Arena arena(1);
    HandScene empty;
    Occluders occluders(arena, TraceIsa::kAvx2);
    occluders.update(empty.evaluated());
    for (const SumsCase& c : sums_cases()) {
        const Reference expected = reference(empty.view, c.light, c.point, c.eye);
        const PolygonShape<float>& shape = c.light.shape;
        const auto seen = see_polygon<float>(shape, c.point.position, c.point.normal);
        const float form_factor = lambert_form_factor(shape, seen, c.point.normal);
        const double closed = static_cast<double>(form_factor * c.light.emission.radiance.x *
                                                  c.point.base_color.x * (1 - c.point.metallic));
        CHECK(closed == doctest::Approx(expected.diffuse.x).epsilon(1e-4));
        // The specular part, which has no closed form, from the cubature.
        const double specular = expected.unshadowed.x - expected.diffuse.x;
        HandTile tile;
        fill(tile, c.point);
        RayScratch scratch;
        TileRun run{&occluders, Visibility::kForcedToOne, c.eye, {}};
        std::vector<double> means;
        for (int replicate = 0; replicate < kReplicates; ++replicate) {
            run.frame.seed = static_cast<std::uint32_t>(replicate) + 1;
            tile.clear_sums();
            add_light(run, c.light, c.samples, tile, scratch);
            means.push_back(tile_mean(tile.unshadowed[0]));
        }
        const Estimate u = estimate(means);
        INFO(c.name << ": " << u.mean << " +- " << u.standard_error << ", expected "
                    << closed + specular);
        CHECK(std::fabs(u.mean - closed - specular) <
              kSignificantT * u.standard_error + 5e-5 * (closed + specular));
    }
}

TEST_CASE(
    "S_N and U_N are the same bits where nothing is in the way, and S_N is 0 in full shadow") {
    HandScene scene;
    scene.add({{-50, 1, -50}, {50, 1, -50}, {0, 1, 50}}, {{{0, 1, 2}}});
    const parallel::Arena arena(1);
    Occluders occluders(arena, TraceIsa::kAvx2);
    occluders.update(scene.evaluated());
    RayScratch scratch;
    for (const SumsCase& c : sums_cases()) {
        HandTile tile;
        fill(tile, c.point);
        TileRun run{&occluders, Visibility::kForcedToOne, c.eye, {}};
        add_light(run, c.light, c.samples, tile, scratch);
        for (std::size_t channel = 0; channel < 3; ++channel)
            CHECK(std::memcmp(tile.shadowed[channel].row(0), tile.unshadowed[channel].row(0),
                              kTilePixels * sizeof(float)) == 0);
        if (c.light.shape.center.y < 1) continue;
        run.visibility = Visibility::kTraced;
        tile.clear_sums();
        add_light(run, c.light, c.samples, tile, scratch);
        CHECK(tile_mean(tile.shadowed[1]) == 0);
        CHECK(tile_mean(tile.unshadowed[1]) > 0);
    }
}

TEST_CASE("rays and sums have the same bits for 8 and 16 lanes") {
    if (!simd::is_supported(simd::Isa::kAvx512)) return;
    const SphereMesh sphere = make_sphere(12);
    HandScene scene;
    scene.add(sphere.positions, sphere.triangles);
    scene.place(0, placed(0.4f, {0.3f, 0.8f, 0}), false);
    const parallel::Arena arena(1);
    Occluders occluders(arena, TraceIsa::kAvx2);
    occluders.update(scene.evaluated());
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1, 1);
    RayScratch scratch;
    for (const SumsCase& c : sums_cases()) {
        HandTile tiles[2];
        for (int pixel = 0; pixel < kUsedPixels; ++pixel) {
            SurfacePoint point = c.point;
            point.position = {unit(random), 0.1f * unit(random), unit(random)};
            point.normal = normalize(Vec3f{unit(random), 1, unit(random)});
            if (pixel % 7 == 3) continue;  // nothing is hit
            for (HandTile& tile : tiles) tile.set(pixel, point);
        }
        for (const simd::Isa isa : {simd::Isa::kAvx2, simd::Isa::kAvx512}) {
            TileRun run{&occluders, Visibility::kTraced, c.eye, {}};
            run.frame.isa = isa;
            add_light(run, c.light, c.samples, tiles[isa == simd::Isa::kAvx512], scratch);
        }
        for (std::size_t channel = 0; channel < 3; ++channel) {
            CHECK(std::memcmp(tiles[0].shadowed[channel].row(0), tiles[1].shadowed[channel].row(0),
                              kTilePixels * sizeof(float)) == 0);
            CHECK(std::memcmp(tiles[0].unshadowed[channel].row(0),
                              tiles[1].unshadowed[channel].row(0),
                              kTilePixels * sizeof(float)) == 0);
        }
        CHECK(tile_mean(tiles[0].shadowed[0]) > 0);
        CHECK(tile_mean(tiles[0].shadowed[0]) < tile_mean(tiles[0].unshadowed[0]));
    }
}

}  // namespace penumbra::shadow
