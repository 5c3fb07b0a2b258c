#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "shadow/occluders.h"
#include "shadow/segment_triangle.h"
#include "tests/shadow/rays_scene.h"

// The exact occluders against a loop over all triangles, for rays that are hard to get right.

namespace penumbra::shadow {
namespace {

std::vector<OccluderSettings> exact_settings() {
    std::vector<OccluderSettings> all;
    for (const simd::Isa isa : {simd::Isa::kAvx2, simd::Isa::kAvx512})
        if (simd::is_supported(isa)) all.push_back({.test = HitTest::kExact, .kernels = isa});
    return all;
}

// Rays in the layout of the packets, as many as one likes.
class Rays {
  public:
    void add(const Vec3f& origin, const Vec3f& direction, float far_limit = 1,
             float near_limit = 0) {
        segments_.push_back({origin, direction, near_limit, far_limit});
    }
    void add_between(const Vec3f& from, const Vec3f& to) { add(from, to - from); }

    [[nodiscard]] const std::vector<Segment>& segments() const { return segments_; }

    [[nodiscard]] std::vector<bool> blocked(const Occluders& occluders) const {
        const parallel::FlushDenormals flush;
        const auto count = static_cast<int>(segments_.size());
        std::vector<Plane<float>> planes;
        for (int i = 0; i < 8; ++i) planes.emplace_back(count + 16, 1);
        for (int i = 0; i < count; ++i) {
            const Segment& s = segments_[static_cast<std::size_t>(i)];
            const float values[8] = {s.origin.x,    s.origin.y,    s.origin.z,   s.direction.x,
                                     s.direction.y, s.direction.z, s.near_limit, s.far_limit};
            for (std::size_t k = 0; k < 8; ++k) planes[k].row(0)[i] = values[k];
        }
        occluders.occlude({{planes[0].row(0), planes[1].row(0), planes[2].row(0)},
                           {planes[3].row(0), planes[4].row(0), planes[5].row(0)},
                           planes[6].row(0),
                           planes[7].row(0),
                           count});
        std::vector<bool> result;
        for (int i = 0; i < count; ++i) result.push_back(planes[7].row(0)[i] < 0);
        return result;
    }

  private:
    std::vector<Segment> segments_;
};

std::vector<bool> blocked_by_any(const SceneView& view, const Rays& rays) {
    const parallel::FlushDenormals flush;
    std::vector<bool> result;
    for (const Segment& segment : rays.segments()) {
        bool blocked = false;
        for (const Instance& instance : view.instances)
            for (const Triangle& t : instance.mesh->triangles) {
                const Vec3f vertices[3] = {instance.positions[t.vertex[0]],
                                           instance.positions[t.vertex[1]],
                                           instance.positions[t.vertex[2]]};
                blocked = blocked || meets(segment, vertices);
            }
        result.push_back(blocked);
    }
    return result;
}

int count_true(const std::vector<bool>& values) {
    return static_cast<int>(std::count(values.begin(), values.end(), true));
}

// All of the scene's exact occluders answer as the loop does.
void check_against_loop(const SceneView& view, const Rays& rays) {
    const parallel::Arena arena(1);
    const std::vector<bool> expected = blocked_by_any(view, rays);
    CHECK(count_true(expected) > 0);
    for (const OccluderSettings& settings : exact_settings()) {
        Occluders occluders(arena, settings);
        occluders.update(view);
        CHECK(rays.blocked(occluders) == expected);
    }
}

class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    float real(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(engine_);
    }
    Vec3f vector(float size) {
        const float x = real(-size, size);
        const float y = real(-size, size);
        const float z = real(-size, size);
        return {x, y, z};
    }

  private:
    std::mt19937 engine_;
};

// From points around `center` to the mesh's vertices, points of its edges and its triangles, short
// of them, to them and beyond.
Rays rays_at_features(const Instance& instance, const Vec3f& center, float size, int step) {
    Rays rays;
    Random random(7);
    const auto& triangles = instance.mesh->triangles;
    for (std::size_t i = 0; i < triangles.size(); i += static_cast<std::size_t>(step)) {
        const auto& [a, b, c] = triangles[i].vertex;
        const Vec3f p = instance.positions[a], q = instance.positions[b], r = instance.positions[c];
        const float along = random.real(0, 1);
        const Vec3f targets[4] = {p, p + (q - p) * 0.5f, q + (r - q) * along,
                                  (p + q + r) * (1.0f / 3)};
        for (const Vec3f& target : targets) {
            const Vec3f from = center + random.vector(size);
            for (const float range : {0.999f, 1.0f, 1.001f, 2.0f})
                rays.add(from, target - from, range);
            rays.add(target, target - from);                // starts on the mesh
            rays.add(from, (target - from) * 1e-3f, 1e3f);  // long in units of its direction
        }
    }
    return rays;
}

// Along the axes, in the planes of boxes, with zeros of both signs.
Rays rays_along_axes(const Instance& instance, float size, int step) {
    Rays rays;
    for (std::size_t i = 0; i < instance.mesh->positions.size();
         i += static_cast<std::size_t>(step))
        for (int axis = 0; axis < 3; ++axis)
            for (const float sign : {-1.0f, 1.0f}) {
                const float zero = sign * 0.0f, length = 2 * sign * size;
                const Vec3f direction = {axis == 0 ? length : zero, axis == 1 ? length : zero,
                                         axis == 2 ? length : zero};
                const Vec3f& p = instance.positions[i];
                rays.add(p - direction * 0.5f, direction);
                rays.add(p, direction);
                rays.add(p - direction * 0.5f, direction, 0.5f);
            }
    return rays;
}

void add_all(const Rays& from, Rays& to) {
    for (const Segment& s : from.segments())
        to.add(s.origin, s.direction, s.far_limit, s.near_limit);
}

void check_mesh(const SphereMesh& mesh, const Affine3f& transform, float size, int step) {
    HandScene scene;
    scene.add(mesh.positions, mesh.triangles);
    scene.place(0, transform, false);
    const SceneView& view = scene.evaluated();
    Rays rays = rays_at_features(view.instances[0], transform.translation, 0.6f * size, step);
    add_all(rays_at_features(view.instances[0], transform.translation, 3 * size, step), rays);
    add_all(rays_along_axes(view.instances[0], size, step), rays);
    check_against_loop(view, rays);
}

SphereMesh triangle_soup(int count, float size, std::uint32_t seed) {
    SphereMesh soup;
    Random random(seed);
    for (int i = 0; i < count; ++i) {
        const Vec3f center = random.vector(1);
        const auto first = static_cast<std::uint32_t>(soup.positions.size());
        for (int vertex = 0; vertex < 3; ++vertex)
            soup.positions.push_back(center + random.vector(size));
        soup.triangles.push_back({{first, first + 1, first + 2}});
    }
    return soup;
}

}  // namespace

TEST_CASE("exact occluders block what a loop over all triangles blocks: closed meshes") {
    check_mesh(make_box(), placed(1, {0, 0, 0}), 1, 1);
    check_mesh(make_sphere(12), placed(1, {0, 0, 0}), 1, 3);
    check_mesh(make_sphere(9), placed(0.7f, {0.1f, -0.3f, 0.2f}), 0.7f, 2);
}

TEST_CASE("exact occluders block what a loop over all triangles blocks: far from the origin") {
    check_mesh(make_sphere(9), placed(1, {1e4f, -1e4f, 2e4f}), 1, 2);
    check_mesh(make_box(), placed(0.01f, {-1e4f, 0, 3e3f}), 0.01f, 1);
    check_mesh(make_sphere(6), placed(1e-3f, {1e4f, 1e4f, 1e4f}), 1e-3f, 1);  // below its rounding
}

TEST_CASE("exact occluders block what a loop over all triangles blocks: large and tiny ones") {
    check_mesh(make_sphere(8), placed(1e6f, {0, 0, 0}), 1e6f, 2);
    check_mesh(make_sphere(8), placed(1e-12f, {0, 0, 0}), 1e-12f, 2);
}

TEST_CASE("exact occluders block what a loop over all triangles blocks: soups and slivers") {
    check_mesh(triangle_soup(300, 0.3f, 1), placed(1, {0, 0, 0}), 1, 3);
    check_mesh(triangle_soup(300, 0.01f, 2), placed(1, {0, 0, 0}), 1, 3);
    SphereMesh slivers = triangle_soup(300, 0.5f, 3);
    for (std::size_t i = 0; i < slivers.positions.size(); i += 3)
        slivers.positions[i + 2] = slivers.positions[i + 1] +
                                   (slivers.positions[i + 2] - slivers.positions[i + 1]) * 1e-6f;
    check_mesh(slivers, placed(1, {0, 0, 0}), 1, 3);
}

TEST_CASE("nothing leaves a closed mesh, through edges and vertices neither") {
    const parallel::Arena arena(1);
    for (const Affine3f& transform : {placed(1, {0, 0, 0}), placed(1, {1e4f, 1e4f, -1e4f})})
        for (const SphereMesh& mesh : {make_box(), make_sphere(24)}) {
            HandScene scene;
            scene.add(mesh.positions, mesh.triangles);
            scene.place(0, transform, false);
            const SceneView& view = scene.evaluated();
            const Instance& instance = view.instances[0];
            const Vec3f center = transform.translation;
            Rays rays;
            Random random(5);
            for (int i = 0; i < 20000; ++i) {
                const auto& vertex =
                    instance.mesh
                        ->triangles[static_cast<std::size_t>(i) % instance.mesh->triangles.size()]
                        .vertex;
                const Vec3f& p = instance.positions[vertex[0]];
                const Vec3f& q = instance.positions[vertex[1]];
                const float along[3] = {0, 0.5f, random.real(0, 1)};
                const Vec3f aim = p + (q - p) * along[i % 3];
                const Vec3f from = center + random.vector(i % 2 != 0 ? 0.25f : 0.0f);
                rays.add(from, (aim - from) * 4.0f);
            }
            for (const OccluderSettings& settings : exact_settings()) {
                Occluders occluders(arena, settings);
                occluders.update(view);
                CHECK(count_true(rays.blocked(occluders)) == 20000);
            }
        }
}

TEST_CASE("moving models block exactly as fixed ones at the same place") {
    const parallel::Arena arena(2);
    const SphereMesh sphere = make_sphere(10);
    for (const OccluderSettings& settings : exact_settings()) {
        HandScene scene;
        scene.add(sphere.positions, sphere.triangles);
        scene.add(sphere.positions, sphere.triangles);
        Occluders kept(arena, settings);
        for (const float x : {0.0f, 0.3f, 1.1f}) {
            scene.place(1, placed(0.5f, {x, 0.2f, 0}), true);
            kept.update(scene.evaluated());
            const Rays rays = rays_at_features(scene.view.instances[1], {x, 0, 0}, 2, 5);
            CHECK(rays.blocked(kept) == blocked_by_any(scene.view, rays));
        }
    }
}

TEST_CASE("exact occluders see the holes of opacity maps as Embree's do") {
    const parallel::Arena arena(1);
    Texture texture;
    constexpr int kSize = 32;
    texture.levels = {{kSize, kSize, 0}};
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            texture.texels.push_back(0xFFFFFFFFu);
            texture.texels.push_back((x / 3 + y / 5) % 2 != 0 ? 0xFFFFFFFFu : 0x0000FFFFu);
        }
    for (const bool is_animated : {false, true}) {
        HandScene scene;
        scene.textures.push_back(texture);
        scene.materials[1].opacity_map = 0;
        Mesh& mesh = scene.add({{-1, 0, -1},
                                {1, 0, -1},
                                {1, 0, 1},
                                {-1, 0, 1},
                                {-1, 1, -1},
                                {0, 1, -1},
                                {0, 1, 1},
                                {-1, 1, 1}},
                               {{{0, 1, 2}}, {{0, 2, 3}}, {{4, 5, 6}}, {{4, 6, 7}}});
        mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 1}};
        mesh.triangle_slots = {1, 1, 0, 1};
        scene.place(0, placed(2, {1, 0, 0}), is_animated);
        const SceneView& view = scene.evaluated();
        Rays rays;
        Random random(6);
        for (int i = 0; i < 4096; ++i) {
            const Vec3f from = Vec3f{1, -1, 0} + random.vector(2),
                        to = Vec3f{1, 3, 0} + random.vector(2);
            rays.add_between(from, to);
        }
        Occluders embree(arena, TraceIsa::kAvx2);
        embree.update(view);
        const std::vector<bool> expected = rays.blocked(embree);
        CHECK(count_true(expected) > 500);
        CHECK(count_true(expected) < 3500);
        for (const OccluderSettings& settings : exact_settings()) {
            Occluders occluders(arena, settings);
            occluders.update(view);
            CHECK(rays.blocked(occluders) == expected);
        }
    }
}

TEST_CASE("the exact answer for a ray does not depend on the rays beside it") {
    const parallel::Arena arena(1);
    const SphereMesh sphere = make_sphere(10);
    HandScene scene;
    scene.add(sphere.positions, sphere.triangles);
    const SceneView& view = scene.evaluated();
    const Rays all = rays_at_features(view.instances[0], {0, 0, 0}, 2, 5);
    for (const OccluderSettings& settings : exact_settings()) {
        Occluders occluders(arena, settings);
        occluders.update(view);
        const std::vector<bool> together = all.blocked(occluders);
        for (std::size_t i = 0; i < together.size(); i += 3) {
            const Segment& s = all.segments()[i];
            Rays alone;
            alone.add(s.origin, s.direction, s.far_limit);
            CHECK(alone.blocked(occluders)[0] == together[i]);
        }
    }
}

}  // namespace penumbra::shadow
