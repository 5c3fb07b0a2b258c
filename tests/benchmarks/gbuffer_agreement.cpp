// Compares the G-buffer with Embree's primary rays through the same pixel centres, on every pixel.
//
//     gbuffer_agreement [--size WxH] [--frames FIRST,SECOND,...] [--threads N] SCENE...
//
// Default: 1920 x 1080, the first and the last frame of each scene, 2 threads. Exits with 1 where a
// pixel differs without an excuse; see tests/renderer/gbuffer_agreement.h for what excuses.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "core/scene/read_scene.h"
#include "tests/renderer/gbuffer_agreement.h"

using namespace penumbra;

namespace {

struct Options {
    std::string size = "1920x1080";
    std::vector<int> frames;
    int threads = 2;
    std::vector<std::string> scenes;
};

void print(const std::string& scene, int frame, const tests::Agreement& a) {
    const auto percent = [&](std::size_t n) {
        return 100.0 * static_cast<double>(n) / static_cast<double>(a.pixels);
    };
    fmt::print(
        "{:<60} frame {:3}: {} pixels, {:.1f} % covered, {:.4f} % agree, excused: {} near "
        "an edge ({:.4f} %), {} by depth ({:.4f} %); unexcused: {} triangle, {} depth, {} "
        "normal; worst {:.1f} / {:.1f} roundings\n",
        scene, frame, a.pixels, percent(a.covered), percent(a.agreeing), a.near_edge,
        percent(a.near_edge), a.same_depth, percent(a.same_depth), a.triangle, a.depth, a.normal,
        a.worst_depth, a.worst_normal);
    for (const tests::Disagreement& d : a.examples)
        fmt::print("  pixel {}, {}: {}\n", d.x, d.y, d.what);
    std::fflush(stdout);
}

bool agrees(const std::string& file, const Options& options) {
    tests::AgreementSettings settings{.threads = options.threads};
    if (std::sscanf(options.size.c_str(), "%dx%d", &settings.width, &settings.height) != 2)
        throw std::invalid_argument("--size: expected WIDTHxHEIGHT");
    const Scene scene = read_scene(file);
    std::vector<int> frames = options.frames;
    if (frames.empty()) frames = {scene.animation.first_frame, scene.animation.last_frame};
    if (frames.size() == 2 && frames[0] == frames[1]) frames.pop_back();
    bool all = true;
    for (const int frame : frames) {
        settings.frame = frame;
        const tests::Agreement agreement = tests::compare_with_rays(scene, settings);
        print(file, frame, agreement);
        all &= agreement.unexcused() == 0;
    }
    return all;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Compares the G-buffer with Embree's primary rays.");
    app.add_option("--size", options.size);
    app.add_option("--frames", options.frames)->delimiter(',');
    app.add_option("--threads", options.threads);
    app.add_option("scenes", options.scenes)->required();
    CLI11_PARSE(app, argc, argv);
    bool all = true;
    try {
        for (const std::string& scene : options.scenes) all &= agrees(scene, options);
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return 2;
    }
    return all ? 0 : 1;
}
