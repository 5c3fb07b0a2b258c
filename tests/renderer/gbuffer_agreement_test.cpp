#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "core/scene/read_scene.h"
#include "tests/renderer/gbuffer_agreement.h"
#include "tests/skip.h"

// At full size: tests/benchmarks/gbuffer_agreement.cpp.

using namespace penumbra;
using namespace penumbra::tests;

namespace {

void check_frame(const Scene& scene, int frame) {
    const Agreement a =
        compare_with_rays(scene, {.width = 240, .height = 136, .frame = frame, .threads = 2});
    CAPTURE(frame);
    CHECK(a.covered > 0);
    CHECK(a.unexcused() == 0);
    CHECK(a.near_edge + a.same_depth < a.pixels / 100);
    for (const Disagreement& d : a.examples) MESSAGE(d.x << ", " << d.y << ": " << d.what);
}

void check_scene(const std::filesystem::path& file) {
    CAPTURE(file.string());
    const Scene scene = read_scene(file);
    check_frame(scene, scene.animation.first_frame);
    if (scene.animation.last_frame > scene.animation.first_frame)
        check_frame(scene, scene.animation.last_frame);
}

std::vector<std::filesystem::path> scene_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

const std::filesystem::path kSource = PENUMBRA_SOURCE_DIR;

}  // namespace

TEST_CASE("the G-buffer of our scenes is what primary rays see") {
    const auto files = scene_files(kSource / "data/scenes");
    REQUIRE(files.size() >= 5);
    for (const auto& file : files) check_scene(file);
}

TEST_CASE("the G-buffer of real scenes is what primary rays see") {
    std::string absent;
    for (const auto& file : scene_files(kSource / "tests/scenes")) {
        try {
            static_cast<void>(read_scene(file));
        } catch (const InputError&) {  // its models belong to others and may be absent
            absent += " " + file.stem().string();
            continue;
        }
        check_scene(file);
    }
    if (!absent.empty()) report_skip("real scenes whose models are absent:" + absent);
}
