#include "apps/bench/report_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/image/file_reader.h"
#include "core/json/node.h"

namespace penumbra::bench {
namespace {

using json::Node;

constexpr int kMostInt = std::numeric_limits<int>::max();
// What a double holds exactly.
constexpr json::Range kCount{0, 9007199254740992.0};
constexpr json::Range kMilliseconds{0, 1e9};
constexpr json::Range kRate{0, 1e18};
constexpr json::Range kShare{0, 1e6};

std::uint64_t count_of(const Node& node) {
    return static_cast<std::uint64_t>(node.number(kCount));
}

// Shorter ones are no times, and ratios of such are no numbers.
constexpr double kLeastTime = 1e-9;

double milliseconds(const Node& node) {
    const double value = node.number(kMilliseconds);
    if (value > 0 && value < kLeastTime)
        node.expected(fmt::format("0 or at least {} milliseconds", kLeastTime));
    return value;
}

void read_caches(const Node& context, Machine& machine) {
    const auto caches = context.find("caches");
    if (!caches) return;
    for (std::size_t i = 0; i < caches->size(); ++i) {
        const Node cache = (*caches)[i];
        machine.caches.push_back({.level = cache.require("level").integer(0, 99),
                                  .type = cache.require("type").text(),
                                  .bytes = count_of(cache.require("size")),
                                  .sharing = cache.require("num_sharing").integer(0, kMostInt)});
    }
}

Machine read_machine(const Node& context) {
    Machine machine{.processor = context.require("processor").text(),
                    .host = context.require("host_name").text(),
                    .date = context.require("date").text(),
                    .processors = context.require("num_cpus").integer(1, kMostInt),
                    .is_scaling = context.require("cpu_scaling_enabled").boolean(),
                    .megahertz = context.require("mhz_per_cpu").number(),
                    .kernel_isa = context.require("kernel_isa").text(),
                    .trace_isa = context.require("trace_isa").text(),
                    .software = context.require("software").text(),
                    .counters = context.require("hardware_counters").text()};
    read_caches(context, machine);
    if (const auto load = context.find("load_avg"))
        for (std::size_t i = 0; i < load->size(); ++i) machine.load.push_back((*load)[i].number());
    return machine;
}

SceneResult read_scene_entry(const Node& scene) {
    return {.name = scene.require("name").text(),
            .path = scene.require("path").text(),
            .frame = scene.require("frame").integer(-kMostInt, kMostInt),
            .width = scene.require("width").integer(1, kMostInt),
            .height = scene.require("height").integer(1, kMostInt),
            .samples_per_pixel = scene.require("samples_per_pixel").integer(1, kMostInt),
            .triangles = count_of(scene.require("triangles")),
            .lights = count_of(scene.require("lights")),
            .shadow_rays = count_of(scene.require("shadow_rays")),
            .covered_pixels = count_of(scene.require("covered_pixels")),
            .peak_memory_bytes = count_of(scene.require("peak_memory_bytes"))};
}

LimitKind read_limit(const Node& entry) {
    const auto limit = entry.find("limit");
    if (!limit) return LimitKind::kNone;
    for (const LimitKind kind : {LimitKind::kPrimaryRays, LimitKind::kShadowRays,
                                 LimitKind::kStream, LimitKind::kArithmetic, LimitKind::kSum})
        if (limit->text() == name(kind)) return kind;
    limit->expected("the name of a limit");
}

// The file holds rates; what was done in that time is a whole number.
std::uint64_t work(const Node& entry, std::string_view rate) {
    const auto per_second = entry.find(rate);
    if (!per_second) return 0;
    const double seconds = 1e-3 * entry.require("real_time").number(kMilliseconds);
    return static_cast<std::uint64_t>(std::llround(per_second->number(kRate) * seconds));
}

PassResult read_pass(const Node& entry) {
    PassResult pass{.name = entry.require("pass").text(),
                    .is_tile_pass = entry.require("clock").text() != "wall",
                    .work = {.pixels = work(entry, "pixels_per_second"),
                             .triangles = work(entry, "triangles_per_second"),
                             .rays = work(entry, "rays_per_second"),
                             .bytes = work(entry, "bytes_per_second")},
                    .limit = read_limit(entry)};
    if (const auto call = entry.find("limit_call")) pass.limit_call = call->text();
    if (const auto parts = entry.find("parts"))
        for (std::size_t i = 0; i < parts->size(); ++i) pass.parts.push_back((*parts)[i].text());
    return pass;
}

Sample read_sample(const Node& entry) {
    if (const Node unit = entry.require("time_unit"); unit.text() != "ms") unit.expected("\"ms\"");
    Sample sample{.milliseconds = milliseconds(entry.require("real_time")),
                  .thread_milliseconds = milliseconds(entry.require("cpu_time"))};
    if (const auto limit = entry.find("limit_ms")) sample.limit_milliseconds = milliseconds(*limit);
    if (const auto floor = entry.find("floor_ms")) sample.floor_milliseconds = milliseconds(*floor);
    if (const auto floor = entry.find("limit_floor_ms"))
        sample.limit_floor_milliseconds = milliseconds(*floor);
    if (const auto share = entry.find("core_share")) sample.core_share = share->number(kShare);
    if (const auto launch = entry.find("launch")) sample.launch = launch->integer(0, kMostInt);
    return sample;
}

SceneResult& scene_of(const Node& entry, Report& report) {
    const Node name = entry.require("scene");
    const auto scene = std::find_if(report.scenes.begin(), report.scenes.end(),
                                    [&](const SceneResult& s) { return s.name == name.text(); });
    if (scene == report.scenes.end()) name.expected("one of context.scenes");
    return *scene;
}

ThreadRun& run_of(const Node& entry, SceneResult& scene) {
    const int threads = entry.require("threads").integer(1, kMostInt);
    const auto run = std::find_if(scene.runs.begin(), scene.runs.end(),
                                  [&](const ThreadRun& r) { return r.threads == threads; });
    if (run != scene.runs.end()) return *run;
    scene.runs.push_back({.threads = threads});
    return scene.runs.back();
}

void add_entry(const Node& entry, Report& report) {
    if (entry.require("run_type").text() != "iteration") return;
    ThreadRun& run = run_of(entry, scene_of(entry, report));
    // A pass's entries follow each other.
    if (run.passes.empty() || run.passes.back().name != entry.require("pass").text())
        run.passes.push_back(read_pass(entry));
    run.passes.back().samples.push_back(read_sample(entry));
}

void add_counters(const Node& context, Report& report) {
    const auto counters = context.find("counters_per_frame");
    if (!counters) return;
    for (std::size_t i = 0; i < counters->size(); ++i) {
        const Node entry = (*counters)[i];
        run_of(entry, scene_of(entry, report)).counters =
            HardwareCounters{.cycles = count_of(entry.require("cycles")),
                             .instructions = count_of(entry.require("instructions")),
                             .cache_misses = count_of(entry.require("cache_misses"))};
    }
}

bool has_same_launches(const PassResult& a, const PassResult& b) {
    return std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(), b.samples.end(),
                      [](const Sample& x, const Sample& y) { return x.launch == y.launch; });
}

void require_same_launches(const SceneResult& scene, const ThreadRun& run,
                           const std::filesystem::path& file) {
    for (const PassResult& pass : run.passes)
        if (!has_same_launches(pass, run.passes.front()))
            throw InputError(file, benchmark_name(scene, run, pass),
                             fmt::format("expected its repetitions in the same launches as those "
                                         "of {}",
                                         run.passes.front().name));
}

// What all that follows relies on: every pass has samples, the same repetitions of the same
// launches.
void require_even(const Report& report, const std::filesystem::path& file) {
    for (const SceneResult& scene : report.scenes) {
        const bool is_empty = scene.runs.empty() ||
                              std::any_of(scene.runs.begin(), scene.runs.end(),
                                          [](const ThreadRun& run) { return run.passes.empty(); });
        if (is_empty)
            throw InputError(file, "benchmarks", "none belongs to the scene " + scene.name);
        for (const ThreadRun& run : scene.runs)
            for (const PassResult& pass : run.passes)
                if (pass.samples.size() != run.passes.back().samples.size() ||
                    find(run, pass.name) != &pass)
                    throw InputError(
                        file, benchmark_name(scene, run, pass),
                        fmt::format("expected {} repetitions, one after the other, got {}",
                                    run.passes.back().samples.size(), pass.samples.size()));
        for (const ThreadRun& run : scene.runs) require_same_launches(scene, run, file);
    }
}

}  // namespace

Report parse_report(const std::filesystem::path& file, std::string_view text) {
    const json::Value document = json::parse(file, text);
    const Node root(file, document, "the document");
    const Node context = root.require("context");
    Report report{.machine = read_machine(context),
                  .warmups = context.require("warmups").integer(0, kMostInt),
                  .repetitions = context.require("repetitions").integer(1, kMostInt),
                  .launches = context.require("launches").integer(1, kMostInt)};
    const Node scenes = context.require("scenes");
    for (std::size_t i = 0; i < scenes.size(); ++i)
        report.scenes.push_back(read_scene_entry(scenes[i]));
    const Node benchmarks = root.require("benchmarks");
    for (std::size_t i = 0; i < benchmarks.size(); ++i) add_entry(benchmarks[i], report);
    add_counters(context, report);
    require_even(report, file);
    return report;
}

Report read_report(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = image::read_whole_file(file);
    return parse_report(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace penumbra::bench
