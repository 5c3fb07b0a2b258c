#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/math/frame.h"
#include "tests/shadow/rays_scene.h"

// Neither acne nor leaks, at any scale and place: on a convex closed model a light is seen exactly
// from the facets that face it, whatever the shading normal says.

namespace penumbra::shadow {
namespace {

Vec3f corner(const Instance& instance, const Triangle& triangle, int i) {
    return instance.positions[triangle.vertex[i]];
}

// A point of a triangle from barycentrics, with the rounding that a renderer has.
Vec3f point_on(const Instance& instance, const Triangle& t, float b1, float b2) {
    const Vec3f a = corner(instance, t, 0);
    return fma(corner(instance, t, 1) - a, b1, fma(corner(instance, t, 2) - a, b2, a));
}

Vec3f facet_normal(const Instance& instance, const Triangle& t) {
    const Vec3f a = corner(instance, t, 0);
    return normalize(cross(corner(instance, t, 1) - a, corner(instance, t, 2) - a));
}

struct Counts {
    int rays = 0, acne = 0, leaks = 0;
};

// Random points of the first model; `outside` tells which side of a facet is which.
class Surroundings {
  public:
    Surroundings(HandScene& scene, float scale, const Vec3f& center)
        : instance_(scene.view.instances[0]), scale_(scale), center_(center) {
        occluders_.update(scene.view);
    }

    Counts count(int rounds) {
        Counts counts;
        for (int round = 0; round < rounds; ++round) add_round(counts);
        return counts;
    }

  private:
    float unit() { return std::uniform_real_distribution<float>(0, 1)(random_); }
    Vec3f direction() {
        std::normal_distribution<float> gauss;
        const float x = gauss(random_), y = gauss(random_), z = gauss(random_);
        return normalize(Vec3f{x, y, z});
    }

    PolygonLight random_light() {
        const Vec3f axis = direction();
        const Frame<float> frame = frame_from_normal(-axis);
        const Vec3f middle = center_ + axis * (6 * scale_);
        const Vec3f u = frame.tangent * (0.5f * scale_), v = frame.bitangent * (0.7f * scale_);
        return make_light({middle - u - v, middle + u - v, middle + u + v, middle - u + v}, true);
    }

    void add_round(Counts& counts) {
        const PolygonLight light = random_light();
        std::vector<Vec3f> normals(kTilePixels);
        for (int pixel = 0; pixel < kTilePixels; ++pixel) {
            const auto& triangles = instance_.mesh->triangles;
            const auto index =
                static_cast<std::size_t>(unit() * 0.9999f * static_cast<float>(triangles.size()));
            float b1 = unit(), b2 = unit();
            if (b1 + b2 > 1) b1 = 1 - b1, b2 = 1 - b2;
            is_inner_[static_cast<std::size_t>(pixel)] = std::min({b1, b2, 1 - b1 - b2}) > 0.1f;
            SurfacePoint point;
            point.position = point_on(instance_, triangles[index], b1, b2);
            normals[static_cast<std::size_t>(pixel)] = facet_normal(instance_, triangles[index]);
            point.geometric_normal = normals[static_cast<std::size_t>(pixel)];
            // Whatever the facet: the light is above the shading horizon.
            point.normal = normalize(light.shape.center - point.position);
            tile_.set(pixel, point);
        }
        TileRun run{&occluders_, Visibility::kTraced, center_ + direction() * (3 * scale_), {}};
        run.frame.seed = ++seed_;
        const RayInputs inputs = inputs_of(run, tile_);
        generate_rays(inputs, {only(light), 0, 0, 1}, scratch_);
        trace(occluders_, Visibility::kTraced, scratch_);
        for (int pixel = 0; pixel < kTilePixels; ++pixel)
            judge(pixel, normals[static_cast<std::size_t>(pixel)], counts);
    }

    void judge(int pixel, const Vec3f& normal, Counts& counts) const {
        const int x = pixel % kTileSize, y = pixel / kTileSize;
        const auto row = static_cast<std::size_t>(y);
        if (!((scratch_.active[row] >> x) & 1)) return;
        const Vec3f ray = {scratch_.direction[0].at(x, y), scratch_.direction[1].at(x, y),
                           scratch_.direction[2].at(x, y)};
        const float cosine = dot(normalize(ray), normal);
        const bool visible = (scratch_.visible[row] >> x) & 1;
        ++counts.rays;
        if (cosine > 1e-3f && !visible) ++counts.acne;
        // From its height above the facet a flat ray may pass over the facet's edge: on models a
        // thousand times their size away from the world's origin that height is a thousandth.
        if (cosine < -0.2f && is_inner_[static_cast<std::size_t>(pixel)] && visible) ++counts.leaks;
    }

    parallel::Arena arena_{1};
    Occluders occluders_{arena_, TraceIsa::kAvx2};
    const Instance& instance_;
    float scale_;
    Vec3f center_;
    std::vector<bool> is_inner_ = std::vector<bool>(kTilePixels);
    std::mt19937 random_{11};
    std::uint32_t seed_ = 0;
    HandTile tile_;
    RayScratch scratch_;
};

Affine3f turned(float scale, const Vec3f& translation) {
    const Frame<float> frame = frame_from_normal(normalize(Vec3f{0.3f, 0.5f, 0.7f}));
    return {frame.tangent * scale, frame.bitangent * scale, frame.normal * scale, translation};
}

}  // namespace

TEST_CASE("closed models neither shadow their lit facets nor let light through, at any scale") {
    for (const bool box : {false, true})
        for (const bool is_animated : {false, true})
            for (const float scale : {1e-3f, 1.0f, 1e3f})
                for (const float away : {0.0f, 10.0f, 1000.0f}) {
                    const SphereMesh mesh = box ? make_box() : make_sphere(24);
                    HandScene scene;
                    scene.add(mesh.positions, mesh.triangles);
                    const Vec3f center = Vec3f{0.6f, -0.5f, 0.7f} * (away * scale);
                    scene.place(0, turned(scale, center), is_animated);
                    scene.evaluated();
                    const Counts counts = Surroundings(scene, scale, center).count(3);
                    INFO("box " << box << " animated " << is_animated << " scale " << scale
                                << " away " << away);
                    CHECK(counts.rays > 10000);
                    CHECK(counts.acne == 0);
                    CHECK(counts.leaks == 0);
                }
}

TEST_CASE("a floor of a kilometre has no acne near an eye two metres above it") {
    HandScene scene;
    scene.add({{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}}, quad_triangles());
    scene.place(0, turned(1000, {3, 1, 2}), false);
    const Instance& floor = scene.evaluated().instances[0];
    const parallel::Arena arena(1);
    Occluders occluders(arena, TraceIsa::kAvx2);
    occluders.update(scene.view);
    const Vec3f normal = facet_normal(floor, floor.mesh->triangles[0]);
    const Vec3f u = normalize(floor.positions[1] - floor.positions[0]), v = cross(normal, u);
    const Vec3f over = Vec3f{3, 1, 2} + normal * 2.0f;
    const PolygonLight light = make_light({over, over + u, over + u + v, over + v}, true);
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(-0.004f, 0.004f);
    HandTile tile;
    for (int pixel = 0; pixel < kTilePixels; ++pixel) {
        const float b1 = 0.5f + unit(random), b2 = unit(random);
        const Vec3f at = point_on(floor, floor.mesh->triangles[0], 0.5f - b1 * 0.01f, 0.5f + b2);
        tile.set(pixel, {at, normal, normal});
    }
    RayScratch scratch;
    const TileRun run{&occluders, Visibility::kTraced, over, {}};
    generate_rays(inputs_of(run, tile), {only(light), 0, 0, 1}, scratch);
    trace(occluders, Visibility::kTraced, scratch);
    CHECK(scratch.visible == scratch.active);
    CHECK(scratch.active[0] != 0);
}

TEST_CASE("an open sheet is dark where the light is behind it, whatever its shading normal") {
    HandScene scene;
    scene.add({{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}}, quad_triangles());
    const parallel::Arena arena(1);
    Occluders occluders(arena, TraceIsa::kAvx2);
    occluders.update(scene.evaluated());
    const PolygonLight light =
        make_light({{3, -0.5f, -1}, {3, -0.5f, 1}, {3, -1, 1}, {3, -1, -1}}, true);
    HandTile tile;
    tile.fill({{0.2f, 0, 0.1f}, {0, 1, 0}, normalize(Vec3f{1, 0.5f, 0})});
    RayScratch scratch;
    const TileRun run{&occluders, Visibility::kTraced, {0, 2, 0}, {}};
    generate_rays(inputs_of(run, tile), {only(light), 0, 0, 1}, scratch);
    trace(occluders, Visibility::kTraced, scratch);
    CHECK(scratch.active[5] == ~std::uint64_t(0));
    for (const std::uint64_t row : scratch.visible) CHECK(row == 0);
}

TEST_CASE("an emissive face never blocks rays to itself, nor do its coplanar neighbours") {
    for (const float scale : {1e-3f, 1.0f, 1e3f})
        for (const float away : {0.0f, 300.0f}) {
            // One light of a fan of eight triangles, beside a wall in the same plane.
            HandScene scene;
            std::vector<Vec3f> outline;
            for (int i = 0; i < 8; ++i)
                outline.push_back({0, std::cos(0.785398f * static_cast<float>(i)),
                                   std::sin(0.785398f * static_cast<float>(i))});
            std::vector<Triangle> fan;
            for (std::uint32_t i = 1; i + 1 < 8; ++i) fan.push_back({{0, i, i + 1}});
            scene.add(outline, fan);
            scene.add({{0, 1, -9}, {0, 1, 9}, {0, 9, 9}, {0, 9, -9}}, quad_triangles());
            const Affine3f transform = turned(scale, Vec3f{1, 2, 3} * (away * scale));
            scene.place(0, transform, false);
            scene.place(1, transform, false);
            scene.evaluated();
            const auto& corners = scene.view.instances[0].positions;
            PolygonLight light = make_light({corners.begin(), corners.begin() + 8}, true);
            light.is_geometry = true;
            const parallel::Arena arena(1);
            Occluders occluders(arena, TraceIsa::kAvx2);
            occluders.update(scene.view);
            // Points at all heights over the plane, down to grazing.
            HandTile tile;
            std::mt19937 random(4);
            std::uniform_real_distribution<float> unit(0, 1);
            for (int pixel = 0; pixel < kTilePixels; ++pixel) {
                const float height = std::pow(10.0f, 1 - 5 * unit(random));
                const float y = 6 * unit(random) - 3, z = 6 * unit(random) - 3;
                SurfacePoint point;
                point.position = transform.point({height, y, z});
                point.normal = point.geometric_normal = normalize(
                    light.shape.center - point.position + light.shape.normal * (1e-3f * scale));
                tile.set(pixel, point);
            }
            RayScratch scratch;
            const TileRun run{&occluders, Visibility::kTraced, transform.point({5, 0, 0}), {}};
            generate_rays(inputs_of(run, tile), {only(light), 0, 0, 1}, scratch);
            trace(occluders, Visibility::kTraced, scratch);
            int rays = 0, blocked = 0;
            for (std::size_t row = 0; row < kTileSize; ++row) {
                rays += std::popcount(scratch.active[row]);
                blocked += std::popcount(scratch.active[row] & ~scratch.visible[row]);
            }
            INFO("scale " << scale << " away " << away);
            CHECK(rays > 3000);
            CHECK(blocked == 0);
        }
}

TEST_CASE("up to four samples all lie on the light; rays exist only where light can arrive") {
    const PolygonLight light = make_light({{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}});
    const parallel::Arena arena(1);
    HandScene empty;
    Occluders occluders(arena, TraceIsa::kAvx2);
    occluders.update(empty.evaluated());
    HandTile tile;
    for (int pixel = 0; pixel < kTilePixels; ++pixel) {
        const Vec3f up = {0, 1, 0};
        const int kind = pixel % 4;
        if (kind == 0) tile.set(pixel, {{0, 0, 0}, up, up});
        if (kind == 1) tile.set(pixel, {{0, 3, 0}, -up, -up});  // the light's dark side
        if (kind == 2) tile.set(pixel, {{0, 0, 0}, -up, -up});  // below the horizon
    }
    RayScratch scratch;
    const TileRun run{&occluders, Visibility::kForcedToOne, {0, 1, 3}, {}};
    for (int count = 1; count <= 4; ++count)
        for (int sample = 0; sample < count; ++sample) {
            generate_rays(inputs_of(run, tile), {only(light), 0, sample, count}, scratch);
            for (std::size_t row = 0; row < kTileSize; ++row)
                CHECK(scratch.active[row] == 0x1111111111111111u);
            for (int x = 0; x < kTileSize; x += 4) {
                const float end_x = scratch.origin[0].at(x, 9) + scratch.direction[0].at(x, 9);
                const float end_y = scratch.origin[1].at(x, 9) + scratch.direction[1].at(x, 9);
                CHECK(std::fabs(end_x) <= 1.0001f);
                CHECK(end_y == doctest::Approx(2).epsilon(1e-6));
                CHECK(scratch.range.at(x, 9) < 1);
                CHECK(scratch.range.at(x, 9) > 0.9999f);
            }
        }
}

}  // namespace penumbra::shadow
