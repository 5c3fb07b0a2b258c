// Judges the unshadowed light U of frames: the analytic U against the frame's own shadow rays,
// untraced, many of them, on the same G-buffer.
//
//     unshadowed_error [--size WxH] [--rays N] [--threads N] [--images DIR] [--fast] [--fail]
//     [SCENE...]
//
// Default: the first frame of all scenes of data/scenes and tests/scenes at 480 x 270 and 4096
// rays per pixel, 2 threads. Per scene, over the lit pixels: mean and RMSE in percent of the mean
// radiance, the 99th percentile of a pixel's relative error, and FLIP; mean and RMSE also by the
// cosine of the view's angle and by material. What the reference's own noise makes of each is taken
// away, except from the percentile, and stands beside it. --images writes U, the reference and
// their relative difference. Exits with 1 where --fail is given and a scene misses a bar.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/error.h"
#include "core/profile/stopwatch.h"
#include "core/scene/read_scene.h"
#include "tests/benchmarks/unshadowed_measure.h"
#include "tests/skip.h"

using namespace penumbra;
using tests::Group;
using tests::UnshadowedErrors;

namespace {

namespace fs = std::filesystem;

// What a right U does not exceed: shares of the mean radiance, and FLIP.
constexpr double kMeanBar = 0.001;
constexpr double kRmseBar = 0.005;
constexpr double kFlipBar = 0.003;

constexpr std::size_t kShownMaterials = 8;

struct Options {
    std::string size = "480x270";
    int rays = 4096;
    int threads = 2;
    fs::path images;
    bool fails = false;
    bool fast = false;
    std::vector<fs::path> scenes;
};

const char* verdict(bool is_ok) {
    return is_ok ? "ok  " : "over";
}

// A scene's numbers in the summary.
struct Row {
    std::string name;
    double mean, rmse, relative_99, flip;
    [[nodiscard]] bool has_mean() const { return std::abs(mean) <= kMeanBar; }
    [[nodiscard]] bool has_rmse() const { return rmse <= kRmseBar; }
    [[nodiscard]] bool has_flip() const { return flip <= kFlipBar; }
    [[nodiscard]] bool is_ok() const { return has_mean() && has_rmse() && has_flip(); }
};

Row row_of(const std::string& name, const UnshadowedErrors& e) {
    const double unit = e.radiance > 0 ? e.radiance : 1;
    return {name, e.all.mean() / unit, e.all.rmse() / unit, e.relative_99, e.flip.at_most()};
}

void print(const Group& group, const UnshadowedErrors& e) {
    const double all = e.all.squared - e.all.noise;
    fmt::print(
        "  {:<28} {:5.1f} % of pixels  mean {:+7.3f} %  RMSE {:7.3f} %  {:5.1f} % of squares\n",
        group.name, 100 * group.pixels / std::max(e.all.pixels, 1.0),
        100 * group.mean() / e.radiance, 100 * group.rmse() / e.radiance,
        all > 0 ? 100 * std::max(group.squared - group.noise, 0.0) / all : 0.0);
}

void print(const Row& row, const UnshadowedErrors& e, double seconds) {
    fmt::print("{}: {:.1f} % lit, mean radiance {:.4g}, FLIP at {:+.2f} EV, {:.1f} s\n", row.name,
               100 * e.all.pixels / e.pixels, e.radiance, e.flip.exposure_ev, seconds);
    if (!(e.radiance > 0)) return;
    fmt::print("  mean             {:+8.3f} %  {}  (noise {:.3f} %)\n", 100 * row.mean,
               verdict(row.has_mean()), 100 * e.noise_of_mean / e.radiance);
    fmt::print("  RMSE             {:8.3f} %  {}  (at most {:.3f} %; noise {:.3f} %)\n",
               100 * row.rmse, verdict(row.has_rmse()), 100 * e.all.rmse_at_most() / e.radiance,
               100 * e.all.noise_rms() / e.radiance);
    fmt::print("  99th percentile  {:8.3f} %        (noise {:.3f} %)\n", 100 * row.relative_99,
               100 * e.noise_relative_99);
    fmt::print(
        "  FLIP             {:8.5f}    {}  (at least {:.5f}; with noise {:.5f}, noise {:.5f}, "
        "between the halves {:.5f})\n",
        row.flip, verdict(row.has_flip()), e.flip.at_least(), e.flip.test, e.flip.noise,
        e.flip.halves);
    for (const Group& group : e.by_cos_view) print(group, e);
    for (std::size_t i = 0; i < std::min(kShownMaterials, e.by_material.size()); ++i)
        if (e.by_material[i].pixels > 0) print(e.by_material[i], e);
    std::fflush(stdout);
}

void print_summary(const std::vector<Row>& rows) {
    fmt::print("\n| scene | mean | RMSE | 99th percentile | FLIP | |\n|---|---|---|---|---|---|\n");
    for (const Row& row : rows)
        fmt::print("| {} | {:+.3f} % | {:.3f} % | {:.2f} % | {:.4f} | {} |\n", row.name,
                   100 * row.mean, 100 * row.rmse, 100 * row.relative_99, row.flip,
                   row.is_ok() ? "ok" : "over");
}

void write_images(const fs::path& folder, const std::string& name,
                  const tests::UnshadowedFrame& frame, const UnshadowedErrors& errors) {
    fs::create_directories(folder);
    const auto file = [&](const char* what) {
        return folder / fmt::format("{}.{}.png", name, what);
    };
    const auto write = [&](const char* what, const Plane3<float>& rgb) {
        const image::ToneMapping mapping{.exposure_ev =
                                             static_cast<float>(errors.flip.exposure_ev)};
        image::write_png(file(what),
                         image::tone_map(view(rgb), frame.width, frame.height, mapping));
    };
    write("U", frame.analytic);
    write("reference", tests::mean_of_halves(frame));
    image::write_png(file("error"), tests::relative_error_picture(frame));
}

Row judge(const fs::path& file, const Scene& scene, const Options& options) {
    tests::UnshadowedSettings settings{
        .frame = scene.animation.first_frame,
        .batches = 2,
        .rays_per_batch = options.rays / 2,
        .seed = 1,
        .threads = options.threads,
        .accuracy = options.fast ? LobeAccuracy::kFast : LobeAccuracy::kExact};
    if (std::sscanf(options.size.c_str(), "%dx%d", &settings.width, &settings.height) != 2 ||
        std::min(settings.width, settings.height) < 1)
        throw InputError(fmt::format("--size: expected WIDTHxHEIGHT, got \"{}\"", options.size));
    const profile::Stopwatch watch;
    const tests::UnshadowedFrame frame = render_unshadowed(scene, settings);
    const UnshadowedErrors errors = measure_unshadowed(frame, scene);
    const Row row = row_of(file.stem().string(), errors);
    print(row, errors, watch.seconds());
    if (!options.images.empty()) write_images(options.images, row.name, frame, errors);
    return row;
}

std::vector<fs::path> scene_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<Row> judge_all(const Options& options) {
    std::vector<Row> rows;
    for (const fs::path& file : options.scenes)
        rows.push_back(judge(file, read_scene(file), options));
    if (!options.scenes.empty()) return rows;
    for (const fs::path& file : scene_files(PENUMBRA_SOURCE_DIR "/data/scenes"))
        rows.push_back(judge(file, read_scene(file), options));
    for (const fs::path& file : scene_files(PENUMBRA_SOURCE_DIR "/tests/scenes")) {
        std::optional<Scene> scene;
        try {
            scene = read_scene(file);
        } catch (const InputError& e) {  // its models belong to others and may be absent
            tests::report_skip(e.what());
        }
        if (scene) rows.push_back(judge(file, *scene, options));
    }
    return rows;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Judges the unshadowed light of frames.");
    app.add_option("--size", options.size);
    app.add_option("--rays", options.rays)->check(CLI::Range(2 * tests::kRaysPerSet, 1 << 24));
    app.add_option("--threads", options.threads)->check(CLI::Range(1, 1024));
    app.add_option("--images", options.images);
    app.add_flag("--fast", options.fast, "judge --unshadowed fast");
    app.add_flag("--fail", options.fails);
    app.add_option("scenes", options.scenes);
    CLI11_PARSE(app, argc, argv);
    try {
        const std::vector<Row> rows = judge_all(options);
        print_summary(rows);
        const bool is_ok =
            std::all_of(rows.begin(), rows.end(), [](const Row& r) { return r.is_ok(); });
        return options.fails && !is_ok ? 1 : 0;
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return 2;
    }
}
