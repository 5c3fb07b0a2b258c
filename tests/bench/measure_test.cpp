#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "apps/bench/csv.h"
#include "apps/bench/measure.h"
#include "apps/bench/table.h"
#include "apps/renderer/builtin_scene.h"
#include "apps/renderer/renderer.h"
#include "core/profile/timeline.h"
#include "core/profile/trace.h"

using namespace penumbra;
using namespace penumbra::bench;

namespace {

const std::atomic<bool> kGoOn = false;

BenchSettings small_settings() {
    return {.scenes = {"", ""},
            .image = {.width = 96, .height = 64},
            .threads = {1, 3},
            .warmups = 1,
            .repetitions = 2};
}

// One run for all tests: two scenes, two numbers of threads.
struct Measured {
    Recording recording;
    Report report = measure(small_settings(), {}, kGoOn, &recording);
};
const Measured& measured() {
    static const Measured kMeasured;
    return kMeasured;
}

std::uint64_t digest(const renderer::Film& film) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const Plane<float>& plane : film.beauty)
        for (int y = 0; y < film.window.height(); ++y)
            for (int x = 0; x < film.window.width(); ++x) {
                hash ^= std::bit_cast<std::uint32_t>(plane.at(x, y));
                hash *= 0x100000001b3u;
            }
    return hash;
}

std::uint64_t render_digest(const renderer::ExecutionSettings& execution) {
    static const Scene kScene = renderer::read_builtin_scene();
    renderer::Renderer renderer(kScene, {.width = 200, .height = 120}, execution);
    renderer::Film film;
    renderer.render(3, {renderer::Aov::kBeauty}, film);
    return digest(film);
}

int lines(const std::string& text) {
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("pixels are the same with a profile and without") {
    const std::uint64_t expected = render_digest({.threads = 2});
    profile::Profile profile;
    CHECK(render_digest({.threads = 2, .profile = &profile}) == expected);
    CHECK_FALSE(profile.track(0).slices().empty());
    // One that has no room drops slices, not pixels.
    profile::Profile full(1, 1);
    CHECK(render_digest({.threads = 2, .profile = &full}) == expected);
    CHECK(full.dropped() > 0);
}

TEST_CASE("a frame's slices are one per tile and pass, and agree with the statistics") {
    static const Scene kScene = renderer::read_builtin_scene();
    profile::Profile profile;
    renderer::Renderer renderer(kScene, {.width = 256, .height = 128},
                                {.threads = 2, .profile = &profile});
    renderer::Film film;
    const renderer::FrameStatistics frame = renderer.render(1, {renderer::Aov::kBeauty}, film);
    for (const renderer::Pass pass :
         {renderer::Pass::kRasterize, renderer::Pass::kTrace, renderer::Pass::kDeposit}) {
        const std::string_view name = renderer::name(pass);
        const double seconds =
            1e-9 * static_cast<double>(total(profile, profile::Kind::kPass, name));
        CHECK(seconds == doctest::Approx(frame.passes[pass]).epsilon(1e-6));
    }
    int tiles = 0;
    for (int worker = 0; worker < 2; ++worker)
        for (const profile::Slice& slice : profile.track(worker).slices())
            tiles += slice.kind == profile::Kind::kPass && std::string(slice.name) == "rasterize";
    CHECK(tiles == 8);
}

TEST_CASE("a report has every scene, number of threads, pass and repetition") {
    const Report& report = measured().report;
    REQUIRE(report.scenes.size() == 2);
    CHECK(report.scenes[0].name == "built-in");
    CHECK(report.scenes[1].name == "built-in-2");
    for (const SceneResult& scene : report.scenes) {
        REQUIRE(scene.runs.size() == 2);
        CHECK(scene.runs[1].threads == 3);
        CHECK(scene.width == 96);
        CHECK(scene.shadow_rays > 0);
        CHECK(scene.peak_memory_bytes > 0);
        for (const ThreadRun& run : scene.runs) {
            CHECK(whole_frame(run).name == "frame");
            for (const PassResult& pass : run.passes) CHECK(pass.samples.size() == 2);
        }
    }
}

TEST_CASE("every pass of the table has its time, its slices and its row of the report") {
    static const Scene kScene = renderer::read_builtin_scene();
    profile::Profile profile;
    renderer::Renderer renderer(kScene, {.width = 96, .height = 64},
                                {.threads = 2, .profile = &profile});
    renderer::Film film;
    const renderer::FrameStatistics frame = renderer.render(1, {renderer::Aov::kBeauty}, film);
    const ThreadRun& run = measured().report.scenes[0].runs[0];
    std::size_t row = 0;
    for (const renderer::PassInfo& pass : renderer::kPasses) {
        CAPTURE(std::string(pass.name));
        const bool is_tile_pass = pass.scope == renderer::PassScope::kTile;
        CHECK(frame.passes[pass.pass] > 0);
        CHECK(total(profile, is_tile_pass ? profile::Kind::kPass : profile::Kind::kPhase,
                    pass.name) > 0);
        CHECK(run.passes[row].name == pass.name);
        CHECK(run.passes[row].is_tile_pass == is_tile_pass);
        CHECK(run.passes[row].limit == pass.limit);
        ++row;
    }
    CHECK(run.passes[row].name == "other");
}

TEST_CASE("groups and the frame tell the work of their passes") {
    const SceneResult& scene = measured().report.scenes[0];
    const std::uint64_t pixels = 96 * 64;
    const auto work = [&](const char* name) { return find(scene.runs[0], name)->work; };
    CHECK(work("visibility") == profile::Work{.pixels = pixels, .triangles = scene.triangles});
    CHECK(work("shadow") == profile::Work{.pixels = pixels, .rays = scene.shadow_rays});
    CHECK(work("denoise") == profile::Work{.pixels = pixels, .bytes = pixels * (40 + 148)});
    CHECK(work("frame") ==
          profile::Work{.pixels = pixels, .triangles = scene.triangles, .rays = scene.shadow_rays});
    CHECK(find(scene.runs[0], "shadow")->parts ==
          std::vector<std::string>{"shade", "rays", "trace"});
}

TEST_CASE("the frame's limit is that of bare rays, arithmetic and streams, without setup") {
    for (const ThreadRun& run : measured().report.scenes[0].runs) {
        double sum = 0;
        for (const char* pass :
             {"rasterize", "shade", "rays", "trace", "deposit", "noise", "filter"})
            sum += find(run, pass)->samples[0].limit_milliseconds;
        CHECK(whole_frame(run).samples[0].limit_milliseconds == doctest::Approx(sum));
        CHECK(find(run, "visibility")->samples[0].limit_milliseconds ==
              find(run, "resolve")->samples[0].limit_milliseconds);
    }
}

TEST_CASE("every pass with a limit has a fraction, and all are finite") {
    for (const ThreadRun& run : measured().report.scenes[0].runs)
        for (const PassResult& pass : run.passes) {
            CHECK((pass.limit == LimitKind::kNone) == fractions(pass).empty());
            for (const double fraction : fractions(pass)) {
                CHECK(std::isfinite(fraction));
                CHECK(fraction > 0);
            }
        }
}

TEST_CASE("the passes and what lies between them add up to the frame") {
    for (const ThreadRun& run : measured().report.scenes[0].runs)
        for (std::size_t i = 0; i < 2; ++i) {
            double sum = 0;
            for (const PassResult& pass : run.passes)
                if (pass.parts.empty() && pass.name != "frame") sum += pass.samples[i].milliseconds;
            CHECK(sum == doctest::Approx(whole_frame(run).samples[i].milliseconds).epsilon(1e-3));
        }
}

TEST_CASE("floors are the repetition where there is one, and never above one of several") {
    const auto is_below = [](double floor, double milliseconds) {
        return floor <= milliseconds * (1 + 1e-6);
    };
    for (const ThreadRun& run : measured().report.scenes[0].runs)
        for (const PassResult& pass : run.passes) {
            if (!pass.is_tile_pass) continue;
            for (const Sample& sample : pass.samples) {
                CHECK(sample.floor_milliseconds > 0);
                CHECK(is_below(sample.floor_milliseconds, sample.milliseconds));
                CHECK(is_below(sample.limit_floor_milliseconds, sample.limit_milliseconds));
            }
        }
    BenchSettings settings = small_settings();
    settings.scenes = {""};
    settings.repetitions = 1;
    const Report once = measure(settings, {}, kGoOn, nullptr);
    for (const ThreadRun& run : once.scenes[0].runs) {
        double sum = 0;
        for (const PassResult& pass : run.passes) {
            const Sample& sample = pass.samples[0];
            if (pass.is_tile_pass)
                CHECK(sample.floor_milliseconds ==
                      doctest::Approx(sample.milliseconds).epsilon(1e-6));
            CHECK(sample.limit_floor_milliseconds ==
                  doctest::Approx(sample.limit_milliseconds).epsilon(1e-6));
            if (pass.parts.empty() && pass.name != "frame") sum += sample.floor_milliseconds;
        }
        CHECK(whole_frame(run).samples[0].floor_milliseconds == doctest::Approx(sum));
    }
}

TEST_CASE("every repetition tells what its cores gave it, all passes the same") {
    for (const ThreadRun& run : measured().report.scenes[0].runs)
        for (const PassResult& pass : run.passes)
            for (std::size_t i = 0; i < pass.samples.size(); ++i) {
                CHECK(pass.samples[i].core_share > 0);
                CHECK(pass.samples[i].core_share == run.passes[0].samples[i].core_share);
            }
}

TEST_CASE("what cores of our own give is known from an older report of this processor") {
    // Of cores that gave more than any can: every repetition is disturbed.
    Report older = measured().report;
    for (PassResult& pass : older.scenes[0].runs[0].passes)
        for (Sample& sample : pass.samples) sample.core_share = 1e9;
    BenchSettings settings = small_settings();
    settings.scenes = {""};
    settings.threads = {1};
    settings.calls_of = {&older};
    const auto second_line = [&] {
        std::string last;
        const Report report = measure(
            settings, [&](const std::string& line) { last = line; }, kGoOn, nullptr);
        CHECK(whole_frame(report.scenes[0].runs[0]).samples.size() == 2);
        return last;
    };
    CHECK(second_line() == "built-in, 1 thread: 1 of 2, 1 more were disturbed");
    older.machine.processor = "another";
    CHECK(second_line() == "built-in, 1 thread: 2 of 2");
}

TEST_CASE("groups are the sums of their passes") {
    const ThreadRun& run = measured().report.scenes[0].runs[1];
    int groups = 0;
    for (const PassResult& group : run.passes) {
        if (group.parts.empty()) continue;
        ++groups;
        double sum = 0;
        for (const std::string& part : group.parts) sum += find(run, part)->samples[0].milliseconds;
        CHECK(group.samples[0].milliseconds == doctest::Approx(sum));
    }
    CHECK(groups == 3);
}

TEST_CASE("of the recording each thread's outermost slices add up to the whole") {
    for (const profile::Timeline& timeline : timelines(measured().recording.profile)) {
        profile::Nanoseconds sum = 0;
        for (const profile::Timeline::Entry& entry : timeline.entries)
            if (entry.depth == 0) sum += entry.slice.end - entry.slice.begin;
        CHECK(sum == timeline.end - timeline.begin);
    }
    const std::string trace = chrome_trace(measured().recording.profile, "bench");
    for (const char* run : {"built-in, 1 thread\"", "built-in-2, 3 threads\""})
        CHECK(trace.find(run) != std::string::npos);
}

TEST_CASE("table and CSV have a row per scene, threads and pass") {
    const Report& report = measured().report;
    const auto passes = static_cast<int>(report.scenes[0].runs[0].passes.size());
    CHECK(lines(csv(report)) == 1 + 2 * 2 * passes);
    const std::string text = table(report);
    for (const char* word : {"built-in-2, frame 1: 96 x 64", "3 threads", "of limit", "speed-up"})
        CHECK(text.find(word) != std::string::npos);
}

TEST_CASE("an interrupt leaves only whole runs") {
    const std::atomic<bool> cancelled = true;
    const Report report = measure(small_settings(), {}, cancelled, nullptr);
    for (const SceneResult& scene : report.scenes) CHECK(scene.runs.empty());
}
