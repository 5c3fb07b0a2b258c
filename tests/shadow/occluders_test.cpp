#include "shadow/occluders.h"

#include <doctest/doctest.h>
#include <time.h>

#include <bit>
#include <cmath>

#include "core/error.h"
#include "tests/shadow/rays_scene.h"

namespace penumbra::shadow {
namespace {

// Rays between random points of a cube, as many as a tile holds.
class RandomRays {
  public:
    explicit RandomRays(std::uint32_t seed, float size = 2) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(-size, size);
        for (int i = 0; i < kTilePixels; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const float from = unit(random), to = unit(random);
                planes_[axis].row(0)[i] = from;
                planes_[axis + 3].row(0)[i] = to - from;
            }
        }
    }

    void set(int i, const Vec3f& from, const Vec3f& to) {
        const Vec3f direction = to - from;
        const float values[6] = {from.x, from.y, from.z, direction.x, direction.y, direction.z};
        for (std::size_t k = 0; k < 6; ++k) planes_[k].row(0)[i] = values[k];
    }

    // One character per ray.
    [[nodiscard]] std::vector<bool> blocked(const Occluders& occluders, int count = kTilePixels) {
        RayStream rays;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            rays.origin[axis] = planes_[axis].row(0);
            rays.direction[axis] = planes_[axis + 3].row(0);
        }
        rays.near_limit = near_.row(0);
        rays.far_limit = far_.row(0);
        rays.count = count;
        far_.fill(1);
        occluders.occlude(rays);
        std::vector<bool> result;
        for (int i = 0; i < count; ++i) result.push_back(far_.row(0)[i] < 0);
        return result;
    }

  private:
    static Plane<float> plane() { return Plane<float>(kTileSize, kTileSize); }
    Plane<float> planes_[6] = {plane(), plane(), plane(), plane(), plane(), plane()};
    Plane<float> near_ = plane(), far_ = plane();
};

int count_true(const std::vector<bool>& values) {
    int count = 0;
    for (const bool value : values) count += value;
    return count;
}

// A fixed ball, a moving ball and a moving box.
void fill(HandScene& scene) {
    const SphereMesh sphere = make_sphere(16), box = make_box();
    scene.add(sphere.positions, sphere.triangles);
    scene.add(sphere.positions, sphere.triangles);
    scene.add(box.positions, box.triangles);
    scene.place(0, placed(0.5f, {-1, 0, 0}), false);
}

void move(HandScene& scene, float time) {
    scene.place(1, placed(0.4f, {1, std::sin(time), 0}), true);
    scene.place(2, placed(0.2f + 0.1f * time, {0, -1, time}), true);
    scene.evaluated();
}

// Moving models as instances, the box alone in world space, and all of them.
constexpr std::size_t kRebuiltLimits[] = {0, 12, 1 << 16};

OccluderSettings settings(std::size_t most_rebuilt) {
    return {.most_rebuilt = most_rebuilt};
}

}  // namespace

TEST_CASE("names of the ray tracer's instruction sets are checked") {
    CHECK(parse_trace_isa("avx2") == TraceIsa::kAvx2);
    CHECK(parse_trace_isa("auto") == TraceIsa::kAuto);
    for (const char* name : {"", "bogus", "AVX2", "avx", "avx2 "})
        CHECK_THROWS_AS(static_cast<void>(parse_trace_isa(name)), InputError);
}

TEST_CASE("a scene without triangles blocks nothing") {
    const parallel::Arena arena(1);
    HandScene scene;
    Occluders occluders(arena, TraceIsa::kAvx2);
    occluders.update(scene.evaluated());
    CHECK(count_true(RandomRays(1).blocked(occluders)) == 0);
}

TEST_CASE("moved models block as a fresh build of the same moment does, bit for bit") {
    const parallel::Arena arena(2);
    for (const std::size_t most_rebuilt : kRebuiltLimits) {
        HandScene scene;
        fill(scene);
        move(scene, 0);
        Occluders kept(arena, settings(most_rebuilt));
        kept.update(scene.view);
        std::vector<bool> before;
        for (const float time : {0.1f, 0.9f, 0.3f, 1.2f}) {
            move(scene, time);
            kept.update(scene.view);
            Occluders fresh(arena, settings(most_rebuilt));
            fresh.update(scene.view);
            const std::vector<bool> blocked = RandomRays(3).blocked(kept);
            CHECK(blocked == RandomRays(3).blocked(fresh));
            CHECK(blocked != before);
            CHECK(count_true(blocked) > 100);
            before = blocked;
        }
    }
}

TEST_CASE("a model blocks the same rays whether it is fixed, rebuilt or instanced") {
    // Rays that end within rounding of the surface may differ; random ones do not come that close.
    const parallel::Arena arena(1);
    const auto blocked = [&](bool is_animated, std::size_t most_rebuilt) {
        HandScene scene;
        fill(scene);
        move(scene, 0.7f);
        scene.place(1, scene.view.instances[1].world_from_object, is_animated);
        scene.place(2, scene.view.instances[2].world_from_object, is_animated);
        Occluders occluders(arena, settings(most_rebuilt));
        occluders.update(scene.evaluated());
        return RandomRays(5).blocked(occluders);
    };
    const std::vector<bool> fixed = blocked(false, 0);
    for (const std::size_t most_rebuilt : kRebuiltLimits)
        CHECK(blocked(true, most_rebuilt) == fixed);
}

TEST_CASE("a model that comes to rest and is evaluated elsewhere is not forgotten") {
    const parallel::Arena arena(1);
    HandScene scene;
    fill(scene);
    move(scene, 0.4f);
    Occluders occluders(arena, settings(kRebuiltLimits[2]));
    occluders.update(scene.view);
    const std::vector<bool> blocked = RandomRays(3).blocked(occluders);
    // The same place, but other memory: the old one is gone.
    for (Instance& instance : scene.view.instances)
        if (instance.is_animated) instance.positions = std::vector<Vec3f>(instance.positions);
    occluders.update(scene.view);
    CHECK(RandomRays(3).blocked(occluders) == blocked);
}

TEST_CASE("a changed model is noticed although its mesh is the same") {
    const parallel::Arena arena(1);
    HandScene scene;
    const SphereMesh box = make_box();
    scene.add(box.positions, box.triangles);
    Occluders occluders(arena, TraceIsa::kAvx2);
    occluders.update(scene.evaluated());
    const int before = count_true(RandomRays(2).blocked(occluders));
    scene.place(0, placed(0.1f, {0, 0, 0}), false);
    occluders.update(scene.evaluated());
    const int after = count_true(RandomRays(2).blocked(occluders));
    CHECK(after > 0);
    CHECK(after < before / 4);
}

TEST_CASE("the number of threads changes no bit") {
    const SphereMesh sphere = make_sphere(150);
    std::vector<bool> results[3];
    for (const int threads : {1, 2, 3}) {
        const parallel::Arena arena(threads);
        HandScene scene;
        scene.add(sphere.positions, sphere.triangles);
        Occluders occluders(arena, TraceIsa::kAvx2);
        occluders.update(scene.evaluated());
        results[threads - 1] = RandomRays(8).blocked(occluders);
    }
    CHECK(results[0] == results[1]);
    CHECK(results[0] == results[2]);
}

TEST_CASE("building uses the arena's threads and no others") {
    const auto seconds = [](clockid_t clock) {
        timespec now{};
        clock_gettime(clock, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    };
    const SphereMesh sphere = make_sphere(250);
    HandScene scene;
    scene.add(sphere.positions, sphere.triangles);
    scene.evaluated();
    const parallel::Arena arena(1);  // the calling thread
    Occluders occluders(arena, TraceIsa::kAvx2);
    const double own = seconds(CLOCK_THREAD_CPUTIME_ID), all = seconds(CLOCK_PROCESS_CPUTIME_ID);
    occluders.update(scene.view);
    const double own_used = seconds(CLOCK_THREAD_CPUTIME_ID) - own;
    const double others_used = seconds(CLOCK_PROCESS_CPUTIME_ID) - all - own_used;
    CHECK(others_used < 0.1 * own_used);
}

TEST_CASE("the result for a ray does not depend on the rays beside it") {
    const parallel::Arena arena(1);
    HandScene scene;
    fill(scene);
    move(scene, 0.5f);
    for (const std::size_t most_rebuilt : kRebuiltLimits) {
        Occluders occluders(arena, settings(most_rebuilt));
        occluders.update(scene.view);
        const std::vector<bool> all = RandomRays(6).blocked(occluders);
        for (const int count : {1, 7, 16, 33, 1000}) {
            const std::vector<bool> part = RandomRays(6).blocked(occluders, count);
            CHECK(std::equal(part.begin(), part.end(), all.begin()));
        }
    }
}

TEST_CASE("holes of an opacity map let light through, the rest of the triangle does not") {
    const parallel::Arena arena(1);
    for (const char* const kind : {"fixed", "rebuilt", "instanced"}) {
        const bool is_animated = kind != std::string("fixed");
        HandScene scene;
        // Alpha 1 in the left half of the picture, 0 in the right.
        Texture texture;
        constexpr int kSize = 32;
        texture.levels = {{kSize, kSize, 0}};
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                texture.texels.push_back(0xFFFFFFFFu);
                texture.texels.push_back(x < kSize / 2 ? 0xFFFFFFFFu : 0x0000FFFFu);
            }
        scene.textures.push_back(texture);
        scene.materials[1].opacity_map = 0;
        Mesh& mesh = scene.add({{-1, 0, -1},
                                {1, 0, -1},
                                {1, 0, 1},
                                {-1, 0, 1},
                                {-1, -1, -1},
                                {1, -1, -1},
                                {1, -1, -0.5f},
                                {-1, -1, -0.5f}},
                               {{{0, 1, 2}}, {{0, 2, 3}}, {{4, 5, 6}}, {{4, 6, 7}}});
        mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 1}};
        mesh.triangle_slots = {1, 1, 0, 0};
        scene.place(0, placed(3, {1, 2, 3}), is_animated);
        Occluders occluders(arena, settings(kind == std::string("instanced") ? 0 : 100));
        occluders.update(scene.evaluated());
        RandomRays rays(1);
        int expected_blocked = 0;
        std::vector<bool> expected;
        for (int i = 0; i < 1024; ++i) {
            const float x = (static_cast<float>(i % 32) + 0.5f) / 16 - 1;
            const float z = (static_cast<float>(i / 32) + 0.5f) / 16 - 1;
            const Vec3f from = Vec3f{x, -2, z} * 3.0f + Vec3f{1, 2, 3};
            const Vec3f to = Vec3f{x, 2, z} * 3.0f + Vec3f{1, 2, 3};
            rays.set(i, from, to);
            expected.push_back(x < 0 || z < -0.5f);
            expected_blocked += expected.back();
        }
        CHECK(rays.blocked(occluders, 1024) == expected);
        CHECK(expected_blocked > 500);
    }
}

TEST_CASE("the ray tracer's instruction sets agree but for a few rays in a million") {
    if (!simd::is_supported(simd::Isa::kAvx512)) return;
    const SphereMesh sphere = make_sphere(60);
    const parallel::Arena arena(1);
    HandScene scene;
    scene.add(sphere.positions, sphere.triangles);
    scene.evaluated();
    Occluders narrow(arena, TraceIsa::kAvx2), wide(arena, TraceIsa::kAvx512);
    narrow.update(scene.view);
    wide.update(scene.view);
    int different = 0, rays = 0;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        const auto a = RandomRays(seed, 1.2f).blocked(narrow),
                   b = RandomRays(seed, 1.2f).blocked(wide);
        for (std::size_t i = 0; i < a.size(); ++i) different += a[i] != b[i];
        rays += static_cast<int>(a.size());
    }
    MESSAGE(different << " of " << rays << " rays differ");
    CHECK(different <= 5);
}

}  // namespace penumbra::shadow
