#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "apps/renderer/builtin_scene.h"
#include "tests/renderer/embree_bits.h"
#include "tests/renderer/support.h"
#include "tests/skip.h"

// The matrix of "same input, same bits": scenes x threads x tile orders x vector widths, and with
// --reproducible also Embree's instruction sets and, through stored hashes, other machines.

using namespace penumbra;
using namespace penumbra::tests;

namespace {

// Six tiles, none of them square.
constexpr ImageSettings kSmall{.width = 150, .height = 90, .samples_per_pixel = 2};

const char* const kScenes[] = {"builtin", "cornell-box/cornell-box", "cubes/cubes-small",
                               "textured-wall/textured-wall"};

const Scene& scene_of(const std::string& name) {
    static std::map<std::string, Scene> scenes;
    const auto found = scenes.find(name);
    if (found != scenes.end()) return found->second;
    return scenes
        .emplace(name, name == "builtin" ? renderer::read_builtin_scene()
                                         : read_scene(data_scene(name + ".json")))
        .first->second;
}

std::vector<simd::Isa> widths() {
    std::vector<simd::Isa> all = {simd::Isa::kAvx2};
    if (simd::is_supported(simd::Isa::kAvx512)) all.push_back(simd::Isa::kAvx512);
    return all;
}

std::vector<ExecutionSettings> ways_to_run() {
    std::vector<ExecutionSettings> all;
    for (const int threads : {1, 2, 7})
        for (const simd::Isa isa : widths())
            for (const std::uint32_t seed : {0u, 1u}) {
                ExecutionSettings way{.threads = threads, .isa = isa};
                if (seed != 0)
                    way.tile_order = {.kind = parallel::TileOrder::Kind::kShuffled,
                                      .seed = seed + static_cast<std::uint32_t>(threads)};
                all.push_back(way);
            }
    return all;
}

// tests/renderer/reproducible_hashes.txt: a scene and a hash per line.
std::filesystem::path hash_file() {
    return std::filesystem::path(PENUMBRA_SOURCE_DIR) / "tests/renderer/reproducible_hashes.txt";
}

std::map<std::string, std::string> stored_hashes() {
    std::map<std::string, std::string> hashes;
    std::ifstream file(hash_file());
    std::string name, hash;
    while (file >> name >> hash) hashes[name] = hash;
    return hashes;
}

ImageSettings reproducible(ImageSettings image) {
    image.reproducible = true;
    return image;
}

int differing_pixels(const Film& a, const Film& b) {
    int differing = 0;
    each_pixel(a, [&](int x, int y) {
        bool same = true;
        for (std::size_t c = 0; c < 3; ++c)
            same = same && a.beauty[c].at(x, y) == b.beauty[c].at(x, y);
        differing += !same;
    });
    return differing;
}

// The shadow rays of a frame, and the scene as they see it.
struct FrameRays {
    std::vector<EmbreeRay> rays;
    SceneView view;
};

FrameRays rays_of_frame(const Scene& scene, const ImageSettings& image) {
    FrameRays result;
    std::mutex mutex;
    const renderer::RayObserver keep = [&](const Tile&, const shadow::RayScratch& scratch) {
        const std::lock_guard lock(mutex);
        for (int y = 0; y < kTileSize; ++y)
            for (int x = 0; x < kTileSize; ++x) {
                if ((scratch.active[static_cast<std::size_t>(y)] >> x & 1u) == 0) continue;
                const auto at = [&](const Plane3<float>& p) {
                    return Vec3f{p[0].at(x, y), p[1].at(x, y), p[2].at(x, y)};
                };
                result.rays.push_back(
                    {at(scratch.origin), at(scratch.direction), scratch.range.at(x, y)});
            }
    };
    render(scene, image, {.on_rays = &keep});
    evaluate(scene, times_of_frame(scene.animation, 1),
             {.width = image.width, .height = image.height}, result.view);
    return result;
}

// Through a point of an edge of each triangle, as near as floats come.
std::vector<EmbreeRay> rays_at_edges(const SceneView& view) {
    std::vector<EmbreeRay> rays;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    for (const Instance& instance : view.instances)
        for (const Triangle& t : instance.mesh->triangles) {
            const Vec3f& a = instance.positions[t.vertex[0]];
            const Vec3f& b = instance.positions[t.vertex[1]];
            const Vec3f aim = a + (b - a) * unit(random);
            const Vec3f span = view.bounds_max - view.bounds_min;
            const float x = unit(random), y = unit(random), z = unit(random);
            const Vec3f origin = view.bounds_min + span * Vec3f{x, y, z};
            rays.push_back({origin, aim - origin, 1.0f + unit(random) * 1e-3f});
        }
    return rays;
}

int differences(const std::vector<bool>& a, const std::vector<bool>& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
    return count;
}

}  // namespace

TEST_CASE("the image depends neither on threads, nor on the order of tiles, nor on vector width") {
    for (const char* name : kScenes)
        for (const bool exact : {false, true}) {
            CAPTURE(name);
            CAPTURE(exact);
            const ImageSettings image = exact ? reproducible(kSmall) : kSmall;
            const std::uint64_t expected = digest(render(scene_of(name), image, {.threads = 1}));
            for (const ExecutionSettings& way : ways_to_run()) {
                CAPTURE(way.threads);
                CHECK(digest(render(scene_of(name), image, way)) == expected);
            }
        }
}

// To accept new images: PENUMBRA_UPDATE_HASHES=1 renderer_tests -tc="*stored hashes*"
TEST_CASE("--reproducible gives the stored hashes on every machine") {
    const bool updates = std::getenv("PENUMBRA_UPDATE_HASHES") != nullptr;
    const std::map<std::string, std::string> stored = stored_hashes();
    std::string text;
    for (const char* name : kScenes) {
        const std::uint64_t hash = digest(render(scene_of(name), reproducible(kSmall)));
        const std::string line = fmt::format("{} {:016x}", name, hash);
        text += line + "\n";
        if (updates) continue;
        CAPTURE(line);
        REQUIRE(stored.contains(name));
        CHECK(stored.at(name) == fmt::format("{:016x}", hash));
    }
    if (updates) std::ofstream(hash_file()) << text;
}

TEST_CASE("--reproducible does not ask for Embree's instruction set") {
    if (!simd::is_supported(simd::Isa::kAvx512)) return report_skip("no AVX-512 on this machine");
    for (const char* name : kScenes) {
        const ImageSettings image = reproducible(kSmall);
        const std::uint64_t expected =
            digest(render(scene_of(name), image, {.trace_isa = shadow::TraceIsa::kAvx2}));
        for (const auto isa : {shadow::TraceIsa::kAvx512, shadow::TraceIsa::kAuto})
            CHECK(digest(render(scene_of(name), image, {.trace_isa = isa})) == expected);
    }
}

TEST_CASE("how many pixels differ without --reproducible is told") {
    int pixels = 0, from_exact = 0, between = 0;
    const bool has_avx512 = simd::is_supported(simd::Isa::kAvx512);
    for (const char* name : kScenes) {
        const Film avx2 = render(scene_of(name), kSmall);
        from_exact += differing_pixels(avx2, render(scene_of(name), reproducible(kSmall)));
        if (has_avx512)
            between += differing_pixels(
                avx2, render(scene_of(name), kSmall, {.trace_isa = shadow::TraceIsa::kAvx512}));
        pixels += kSmall.width * kSmall.height;
    }
    MESSAGE("pixels that differ, of " << pixels << ": Embree avx2 from exact " << from_exact
                                      << ", avx2 from avx512 " << between);
    CHECK(from_exact < pixels / 50);
    CHECK(between < pixels / 50);
}

TEST_CASE("how many rays Embree's instruction sets answer otherwise than the exact test is told") {
    std::map<std::string, std::pair<int, int>>
        differing;  // of the frames' rays and of those at edges
    std::size_t rays = 0, edge_rays = 0;
    for (const char* name : {"cubes/cubes-small", "textured-wall/textured-wall"}) {
        const FrameRays frame = rays_of_frame(scene_of(name), kSmall);
        const std::vector<EmbreeRay> at_edges = rays_at_edges(frame.view);
        const std::vector<bool> exact = exactly_blocked(frame.view, frame.rays);
        const std::vector<bool> exact_at_edges = exactly_blocked(frame.view, at_edges);
        rays += exact.size();
        edge_rays += exact_at_edges.size();
        for (const std::string& isa : embree_isas()) {
            const BareEmbree embree(frame.view, isa);
            for (const int per_call : {0, 1, 8}) {
                auto& [count, count_at_edges] =
                    differing[fmt::format("{}, {} rays per call", isa, per_call)];
                count += differences(embree.blocked(frame.rays, per_call), exact);
                count_at_edges += differences(embree.blocked(at_edges, per_call), exact_at_edges);
            }
        }
    }
    for (const auto& [form, counts] : differing) {
        MESSAGE("Embree " << form << " (0: a stream) differs from exact in " << counts.first
                          << " of " << rays << " rays of frames, " << counts.second << " of "
                          << edge_rays << " rays aimed at edges");
        CHECK(counts.first < static_cast<int>(rays) / 1000);
    }
}
