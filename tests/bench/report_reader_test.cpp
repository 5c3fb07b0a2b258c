#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "apps/bench/report_reader.h"
#include "core/error.h"

using namespace penumbra;
using namespace penumbra::bench;
using nlohmann::ordered_json;

namespace {

ordered_json entry(const std::string& pass, int launch, double milliseconds, double limit) {
    return {{"name", "room/threads:2/" + pass},
            {"run_type", "iteration"},
            {"threads", 2},
            {"real_time", milliseconds},
            {"cpu_time", 2 * milliseconds},
            {"time_unit", "ms"},
            {"rays_per_second", 3e6 / (1e-3 * milliseconds)},
            {"scene", "room"},
            {"pass", pass},
            {"clock", pass == "frame" ? "wall" : "share of all threads"},
            {"limit", pass == "frame" ? "sum" : "shadow rays"},
            {"limit_call", "stream"},
            {"launch", launch},
            {"limit_ms", limit},
            {"floor_ms", 0.75 * milliseconds},
            {"limit_floor_ms", 0.5 * limit},
            {"core_share", 2.5},
            {"a key of a later version", 1}};
}

ordered_json document() {
    ordered_json root;
    root["context"] = {
        {"date", "2026-01-02T03:04:05+00:00"},
        {"host_name", "farm"},
        {"num_cpus", 2},
        {"mhz_per_cpu", 2600},
        {"cpu_scaling_enabled", true},
        {"caches", {{{"type", "Data"}, {"level", 1}, {"size", 32768}, {"num_sharing", 1}}}},
        {"load_avg", {0.5, 1.25}},
        {"software", "penumbra 0.1.0"},
        {"processor", "AMD EPYC"},
        {"kernel_isa", "avx512"},
        {"trace_isa", "avx2"},
        {"hardware_counters", "available"},
        {"warmups", 2},
        {"repetitions", 1},
        {"launches", 2}};
    root["context"]["scenes"] = {{{"name", "room"},
                                  {"path", "x/room.json"},
                                  {"frame", 7},
                                  {"width", 640},
                                  {"height", 360},
                                  {"samples_per_pixel", 1},
                                  {"triangles", 588},
                                  {"lights", 1},
                                  {"shadow_rays", 200000},
                                  {"covered_pixels", 230400},
                                  {"peak_memory_bytes", 1048576}}};
    root["context"]["counters_per_frame"] = {{{"scene", "room"},
                                              {"threads", 2},
                                              {"cycles", 5},
                                              {"instructions", 9},
                                              {"cache_misses", 1}}};
    root["benchmarks"] = {entry("trace", 0, 40, 30), entry("trace", 1, 41, 31)};
    root["benchmarks"].push_back({{"name", "mean"}, {"run_type", "aggregate"}});
    root["benchmarks"].push_back(entry("frame", 0, 80, 60));
    root["benchmarks"].push_back(entry("frame", 1, 82, 61));
    return root;
}

// What reading it complains about.
std::string complaint(const ordered_json& root) {
    try {
        static_cast<void>(parse_report("old.json", root.dump()));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a report is read as it was written: machine, scenes, runs, passes, repetitions") {
    const Report report = parse_report("old.json", document().dump());
    CHECK(report.machine.processor == "AMD EPYC");
    CHECK(report.machine.caches[0].bytes == 32768);
    CHECK(report.machine.is_scaling);
    CHECK(report.machine.load == std::vector<double>{0.5, 1.25});
    CHECK(report.launches == 2);
    REQUIRE(report.scenes.size() == 1);
    const SceneResult& scene = report.scenes[0];
    CHECK(scene.path == "x/room.json");
    CHECK(scene.frame == 7);
    CHECK(scene.shadow_rays == 200000);
    REQUIRE(scene.runs.size() == 1);
    const ThreadRun& run = scene.runs[0];
    CHECK(run.threads == 2);
    CHECK(run.counters->instructions == 9);
    REQUIRE(run.passes.size() == 2);
    const PassResult& trace = run.passes[0];
    CHECK(trace.is_tile_pass);
    CHECK(trace.limit == LimitKind::kShadowRays);
    CHECK(trace.limit_call == "stream");
    CHECK(trace.work.rays == 3'000'000);
    REQUIRE(trace.samples.size() == 2);
    CHECK(trace.samples[1].milliseconds == 41);
    CHECK(trace.samples[1].thread_milliseconds == 82);
    CHECK(trace.samples[1].limit_milliseconds == 31);
    CHECK(trace.samples[1].launch == 1);
    CHECK(trace.samples[1].floor_milliseconds == 30.75);
    CHECK(trace.samples[1].limit_floor_milliseconds == 15.5);
    CHECK(trace.samples[1].core_share == 2.5);
    CHECK_FALSE(whole_frame(run).is_tile_pass);
}

TEST_CASE("a report from before floors and shares were measured is read without them") {
    ordered_json root = document();
    for (ordered_json& each : root["benchmarks"])
        for (const char* key : {"floor_ms", "limit_floor_ms", "core_share"}) each.erase(key);
    const Report report = parse_report("old.json", root.dump());
    const Sample& sample = report.scenes[0].runs[0].passes[0].samples[0];
    CHECK(sample.floor_milliseconds == 0);
    CHECK(sample.limit_floor_milliseconds == 0);
    CHECK(sample.core_share == 0);
}

TEST_CASE("what is wrong in a report is told with its place") {
    ordered_json root = document();
    root["context"].erase("processor");
    CHECK(complaint(root) == "old.json: context: \"processor\" is missing");
    CHECK(complaint(root).find("processor") != std::string::npos);

    root = document();
    root["benchmarks"][1]["real_time"] = "fast";
    CHECK(complaint(root).find("benchmarks[1].real_time") != std::string::npos);

    root = document();
    root["benchmarks"][1]["limit_floor_ms"] = 1e-100;
    CHECK(complaint(root).find("benchmarks[1].limit_floor_ms: expected 0 or at least 1e-09") !=
          std::string::npos);

    root = document();
    root["benchmarks"][0]["limit"] = "moonlight";
    CHECK(complaint(root).find("expected the name of a limit") != std::string::npos);

    root = document();
    root["benchmarks"][0]["scene"] = "attic";
    CHECK(complaint(root).find("expected one of context.scenes") != std::string::npos);

    root = document();
    root["benchmarks"][0]["time_unit"] = "ns";
    CHECK(complaint(root).find("expected \"ms\"") != std::string::npos);

    CHECK(complaint(ordered_json{{"benchmarks", ordered_json::array()}}).find("context") !=
          std::string::npos);
    CHECK_THROWS_AS(static_cast<void>(parse_report("old.json", "{")), InputError);
    CHECK_THROWS_AS(static_cast<void>(read_report("/nowhere/old.json")), InputError);
}

TEST_CASE("a report with holes is refused: each pass has every repetition once") {
    ordered_json root = document();
    root["benchmarks"].erase(1);
    CHECK(complaint(root).find("room/threads:2/trace: expected 2 repetitions") !=
          std::string::npos);

    root = document();
    root["benchmarks"][1]["launch"] = 0;
    CHECK(complaint(root).find("frame: expected its repetitions in the same launches as those of "
                               "trace") != std::string::npos);

    root = document();
    root["benchmarks"].push_back(entry("trace", 2, 42, 32));
    CHECK(complaint(root) != "");

    root = document();
    root["benchmarks"] = ordered_json::array();
    CHECK(complaint(root).find("room") != std::string::npos);
}
