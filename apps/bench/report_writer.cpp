#include "apps/bench/report_writer.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace penumbra::bench {
namespace {

using nlohmann::ordered_json;

ordered_json context(const Report& report) {
    const Machine& machine = report.machine;
    ordered_json caches = ordered_json::array();
    for (const Machine::Cache& cache : machine.caches)
        caches.push_back({{"type", cache.type},
                          {"level", cache.level},
                          {"size", cache.bytes},
                          {"num_sharing", cache.sharing}});
    return {
        {"date", machine.date}, {"host_name", machine.host}, {"executable", "penumbra bench"},
            {"num_cpus", machine.processors}, {"mhz_per_cpu", std::llround(machine.megahertz)},
            {"cpu_scaling_enabled", machine.is_scaling}, {"caches", std::move(caches)},
            {"load_avg", machine.load},
#if defined(NDEBUG)
            {"library_build_type", "release"},
#else
            {"library_build_type", "debug"},
#endif
            {"software", machine.software}, {"processor", machine.processor},
            {"kernel_isa", machine.kernel_isa}, {"trace_isa", machine.trace_isa},
            {"hardware_counters", machine.counters}, {"warmups", report.warmups},
            {"repetitions", report.repetitions}, {
            "launches", report.launches
        }
    };
}

ordered_json scene_entry(const SceneResult& scene) {
    return {{"name", scene.name},
            {"path", scene.path},
            {"frame", scene.frame},
            {"width", scene.width},
            {"height", scene.height},
            {"samples_per_pixel", scene.samples_per_pixel},
            {"triangles", scene.triangles},
            {"lights", scene.lights},
            {"shadow_rays", scene.shadow_rays},
            {"covered_pixels", scene.covered_pixels},
            {"peak_memory_bytes", scene.peak_memory_bytes}};
}

// A pass of a run, and its place in the report.
struct Family {
    const SceneResult& scene;
    const ThreadRun& run;
    const PassResult& pass;
    int index;
};

ordered_json common(const Family& family, const std::string& name, const char* run_type) {
    return {{"name", name},
            {"family_index", family.index},
            {"per_family_instance_index", 0},
            {"run_name", benchmark_name(family.scene, family.run, family.pass)},
            {"run_type", run_type},
            {"repetitions", family.pass.samples.size()}};
}

void add_rate(ordered_json& entry, const char* key, std::uint64_t work, double milliseconds) {
    if (work > 0 && milliseconds > 0)
        entry[key] = static_cast<double>(work) / (1e-3 * milliseconds);
}

void add_work(const PassResult& pass, double milliseconds, ordered_json& entry) {
    add_rate(entry, "pixels_per_second", pass.work.pixels, milliseconds);
    add_rate(entry, "triangles_per_second", pass.work.triangles, milliseconds);
    add_rate(entry, "rays_per_second", pass.work.rays, milliseconds);
    add_rate(entry, "bytes_per_second", pass.work.bytes, milliseconds);
}

void add_identity(const Family& family, ordered_json& entry) {
    entry["scene"] = family.scene.name;
    entry["pass"] = family.pass.name;
    if (!family.pass.parts.empty()) entry["parts"] = family.pass.parts;
    entry["clock"] = family.pass.is_tile_pass ? "share of all threads" : "wall";
    if (family.pass.limit == LimitKind::kNone) return;
    entry["limit"] = name(family.pass.limit);
    if (!family.pass.limit_call.empty()) entry["limit_call"] = family.pass.limit_call;
}

ordered_json repetition(const Family& family, std::size_t index) {
    const Sample& sample = family.pass.samples[index];
    ordered_json entry =
        common(family, benchmark_name(family.scene, family.run, family.pass), "iteration");
    entry["repetition_index"] = index;
    entry["threads"] = family.run.threads;
    entry["iterations"] = 1;
    entry["real_time"] = sample.milliseconds;
    entry["cpu_time"] = sample.thread_milliseconds;
    entry["time_unit"] = "ms";
    add_work(family.pass, sample.milliseconds, entry);
    add_identity(family, entry);
    entry["launch"] = sample.launch;
    if (sample.floor_milliseconds > 0) entry["floor_ms"] = sample.floor_milliseconds;
    if (sample.limit_floor_milliseconds > 0)
        entry["limit_floor_ms"] = sample.limit_floor_milliseconds;
    if (sample.core_share > 0) entry["core_share"] = sample.core_share;
    if (family.pass.limit != LimitKind::kNone) {
        entry["limit_ms"] = sample.limit_milliseconds;
        entry["fraction_of_limit"] = fractions(family.pass)[index];
    }
    return entry;
}

struct Aggregate {
    const char* name;
    const char* unit;
    double (*of)(const Summary&);
};
constexpr std::array<Aggregate, 4> kAggregates = {{
    {"mean", "time", [](const Summary& s) { return s.mean; }},
    {"median", "time", [](const Summary& s) { return s.median; }},
    {"stddev", "time", [](const Summary& s) { return s.deviation; }},
    {"cv", "percentage", [](const Summary& s) { return s.variation(); }},
}};

ordered_json aggregate(const Family& family, const Aggregate& kind) {
    const std::string run_name = benchmark_name(family.scene, family.run, family.pass);
    ordered_json entry = common(family, run_name + "_" + kind.name, "aggregate");
    entry["threads"] = family.run.threads;
    entry["aggregate_name"] = kind.name;
    entry["aggregate_unit"] = kind.unit;
    entry["iterations"] = family.pass.samples.size();
    entry["real_time"] = kind.of(summarize(milliseconds(family.pass)));
    entry["cpu_time"] = kind.of(summarize(thread_milliseconds(family.pass)));
    entry["time_unit"] = "ms";
    add_identity(family, entry);
    if (family.pass.limit != LimitKind::kNone)
        entry["fraction_of_limit"] = kind.of(summarize(fractions(family.pass)));
    return entry;
}

void add_family(const Family& family, ordered_json& benchmarks) {
    if (family.pass.samples.empty()) return;
    for (std::size_t i = 0; i < family.pass.samples.size(); ++i)
        benchmarks.push_back(repetition(family, i));
    for (const Aggregate& kind : kAggregates) benchmarks.push_back(aggregate(family, kind));
}

ordered_json counters_entry(const SceneResult& scene, const ThreadRun& run) {
    return {{"scene", scene.name},
            {"threads", run.threads},
            {"cycles", run.counters->cycles},
            {"instructions", run.counters->instructions},
            {"cache_misses", run.counters->cache_misses}};
}

// Infinite where there are too few launches for an interval.
ordered_json number(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json comparison_entry(const Comparison& comparison) {
    ordered_json passes = ordered_json::array();
    for (const PassComparison& pass : comparison.passes)
        passes.push_back({{"scene", pass.scene},
                          {"threads", pass.threads},
                          {"pass", pass.pass},
                          {"old_fraction_of_limit", pass.old_fraction},
                          {"fraction_of_limit", pass.new_fraction},
                          {"change", pass.change},
                          {"change_against", name(pass.reference)},
                          {"change_low", number(pass.low)},
                          {"change_high", number(pass.high)},
                          {"probability_alone", pass.rank_probability},
                          {"probability", pass.probability},
                          {"strength", pass.strength},
                          {"verdict", name(pass.verdict)}});
    return {{"old_launches", comparison.old_launches},
            {"launches", comparison.new_launches},
            {"differences", comparison.differences},
            {"not_compared", comparison.left_out},
            {"passes", std::move(passes)}};
}

}  // namespace

std::string benchmark_json(const Report& report, const Comparison* comparison) {
    ordered_json root = {{"context", context(report)}, {"benchmarks", ordered_json::array()}};
    ordered_json scenes = ordered_json::array();
    ordered_json counters = ordered_json::array();
    int index = 0;
    for (const SceneResult& scene : report.scenes) {
        scenes.push_back(scene_entry(scene));
        for (const ThreadRun& run : scene.runs) {
            if (run.counters) counters.push_back(counters_entry(scene, run));
            for (const PassResult& pass : run.passes)
                add_family({scene, run, pass, index++}, root["benchmarks"]);
        }
    }
    root["context"]["scenes"] = std::move(scenes);
    if (!counters.empty()) root["context"]["counters_per_frame"] = std::move(counters);
    if (comparison) root["comparison"] = comparison_entry(*comparison);
    return root.dump(2, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace penumbra::bench
