#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>
#include <string_view>

#include "apps/bench/comparison.h"
#include "core/error.h"

using namespace penumbra;
using namespace penumbra::bench;

namespace {

// The same numbers on every machine, unlike the standard library's distributions.
class Noise {
  public:
    explicit Noise(std::uint64_t seed) : random_(seed) {}
    double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
    double normal() {
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += unit();
        return sum;
    }

  private:
    std::mt19937_64 random_;
};

// A pass, and how it was measured to behave on a quiet machine with two virtual processors.
struct Model {
    const char* name;
    double milliseconds, limit;
    double launches;  // deviation of pass / limit from launch to launch
};
constexpr Model kModels[] = {
    {"setup", 0.28, 0.003, 0.02}, {"rasterize", 2.0, 9.9, 0.02}, {"resolve", 6.2, 9.9, 0.012},
    {"shade", 10, 1.7, 0.007},    {"rays", 11, 0.8, 0.008},      {"trace", 30, 31, 0.005},
    {"deposit", 2.5, 0.7, 0.03},  {"noise", 3.2, 0.45, 0.009},   {"frame", 73, 47, 0.005},
};

struct Scenario {
    int launches = 6;
    int repetitions = 9;
    std::string slowed;
    double factor = 1;
    int shared = 0;  // of the launches: with cores that others use, too
};

// What a neighbour on the same core does to each pass and to its limit.
constexpr double kSharedPass[] = {1.1, 1.3, 1.35, 1.3, 1.4, 1.2, 1.1, 1.5, 1.25};
constexpr double kSharedLimit = 1.15;

// One launch in ten is disturbed; the clock wanders from launch to launch and meets both; a
// repetition in five is interrupted, in the pass or in its limit.
void add_launch(const Scenario& scenario, int launch, Noise& noise, ThreadRun& run) {
    const double clock = std::exp(0.1 * noise.normal());
    for (std::size_t i = 0; i < std::size(kModels); ++i) {
        const Model& model = kModels[i];
        const double deviation = model.launches * (noise.unit() < 0.1 ? 3 : 1);
        const bool is_shared = launch < scenario.shared;
        const double own = std::exp(deviation * noise.normal()) *
                           (scenario.slowed == model.name ? scenario.factor : 1) *
                           (is_shared ? kSharedPass[i] : 1);
        const double limit = model.limit * (is_shared ? kSharedLimit : 1);
        const auto time = [&](double milliseconds) {
            const double interrupted = noise.unit() < 0.1 ? 1 + noise.unit() : 1;
            return clock * milliseconds * interrupted * std::exp(0.01 * noise.normal());
        };
        for (int repetition = 0; repetition < scenario.repetitions; ++repetition) {
            Sample sample{.launch = launch, .core_share = is_shared ? 2.0 : 3.0};
            sample.milliseconds = time(model.milliseconds * own);
            sample.limit_milliseconds = time(limit);
            sample.floor_milliseconds = clock * model.milliseconds * own;
            sample.limit_floor_milliseconds = clock * limit;
            run.passes[i].samples.push_back(sample);
        }
    }
}

Report report(const Scenario& scenario, Noise& noise) {
    ThreadRun run{.threads = 1};
    for (const Model& model : kModels)
        run.passes.push_back({.name = model.name, .limit = LimitKind::kStream});
    for (int launch = 0; launch < scenario.launches; ++launch)
        add_launch(scenario, launch, noise, run);
    Report result{.machine = {.processor = "one", .processors = 2},
                  .repetitions = scenario.repetitions,
                  .launches = scenario.launches};
    result.scenes.push_back({.name = "room", .width = 640, .height = 360, .runs = {run}});
    return result;
}

const PassComparison& find(const Comparison& comparison, std::string_view pass) {
    for (const PassComparison& each : comparison.passes)
        if (each.pass == pass) return each;
    FAIL("no pass " << pass);
    return comparison.passes.front();
}

bool reports_anything(const Comparison& comparison) {
    for (const PassComparison& pass : comparison.passes)
        if (pass.verdict != Verdict::kNoChange) return true;
    return false;
}

std::string complaint(const Report& then, const Report& now) {
    try {
        static_cast<void>(compare(then, now));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

bool has(const std::vector<std::string>& lines, const std::string& text) {
    for (const std::string& line : lines)
        if (line.find(text) != std::string::npos) return true;
    return false;
}

}  // namespace

TEST_CASE("a pass that got slower by 5 % is found in 9 of 10 comparisons and more" *
          doctest::test_suite("statistics")) {
    // 30 of 30: with a confidence of 95 % more than 0.90 of all.
    Noise noise(1);
    int found = 0;
    for (int trial = 0; trial < 30; ++trial) {
        const Report then = report({.launches = 15}, noise);
        const Report now = report({.launches = 15, .slowed = "shade", .factor = 1.05}, noise);
        found += find(compare(then, now), "shade").verdict == Verdict::kSlower ? 1 : 0;
    }
    CHECK(found == 30);
}

TEST_CASE("where nothing changed, anything at all is reported in less than one of 20 comparisons") {
    // None of 60: with a confidence of 95 % less than 0.049 of all.
    Noise noise(2);
    int alarms = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const Report then = report({}, noise);
        alarms += reports_anything(compare(then, report({}, noise))) ? 1 : 0;
    }
    CHECK(alarms == 0);
}

TEST_CASE("launches with cores that others use, too, change nothing") {
    Noise noise(12);
    const Scenario half{.launches = 16, .shared = 8};
    Report then = report(half, noise);
    const Comparison unchanged = compare(then, report({.launches = 10}, noise));
    CHECK_FALSE(reports_anything(unchanged));
    CHECK(has(unchanged.differences, "room/threads:1: 8 of 16 launches then and 10 of 10 now"));
    Scenario slowed = half;
    slowed.slowed = "shade";
    slowed.factor = 1.05;
    CHECK(find(compare(then, report(slowed, noise)), "shade").verdict == Verdict::kSlower);
    // Not told apart, the same launches hide that.
    for (PassResult& pass : then.scenes[0].runs[0].passes)
        for (Sample& sample : pass.samples) sample.core_share = 0;
    Report untold = report(slowed, noise);
    for (PassResult& pass : untold.scenes[0].runs[0].passes)
        for (Sample& sample : pass.samples) sample.core_share = 0;
    CHECK(find(compare(then, untold), "shade").verdict == Verdict::kNoChange);
}

TEST_CASE("the change is told with its size, its interval and its direction") {
    Noise noise(3);
    const Report then = report({.launches = 8}, noise);
    const Report slow = report({.launches = 7, .slowed = "trace", .factor = 1.3}, noise);
    const Comparison comparison = compare(then, slow);
    CHECK(comparison.old_launches == 8);
    CHECK(comparison.new_launches == 7);
    const PassComparison& trace = find(comparison, "trace");
    CHECK(trace.change == doctest::Approx(0.3).epsilon(0.06));
    CHECK(trace.low < 0.3);
    CHECK(trace.high > 0.3);
    CHECK(trace.low > 0.25);
    CHECK(trace.high < 0.35);
    CHECK(trace.old_fraction / trace.new_fraction == doctest::Approx(1.3).epsilon(0.05));
    CHECK(find(compare(slow, then), "trace").verdict == Verdict::kFaster);
}

TEST_CASE("a machine that got slower as a whole has not changed the fractions") {
    Noise noise(4);
    const Report then = report({}, noise);
    Report now = report({}, noise);
    for (PassResult& pass : now.scenes[0].runs[0].passes)
        for (Sample& sample : pass.samples) {
            sample.milliseconds *= 1.7;
            sample.limit_milliseconds *= 1.7;
        }
    CHECK_FALSE(reports_anything(compare(then, now)));
}

TEST_CASE("slower beyond so many percent means certainly slower, and by more") {
    Noise noise(5);
    const Report then = report({}, noise);
    const Comparison comparison = compare(then, report({.slowed = "shade", .factor = 1.1}, noise));
    REQUIRE(slower_beyond(comparison, 5).size() == 1);
    CHECK(slower_beyond(comparison, 5)[0].pass == "shade");
    CHECK(slower_beyond(comparison, 15).empty());
    CHECK(
        slower_beyond(compare(report({.slowed = "shade", .factor = 1.1}, noise), then), 0).empty());
    CHECK(comparison_table(comparison).find("SLOWER") != std::string::npos);
}

TEST_CASE("launches count, not repetitions: fewer than five are refused") {
    Noise noise(6);
    const Report enough = report({}, noise);
    const Report few = report({.launches = 4, .repetitions = 50}, noise);
    CHECK(complaint(enough, few).starts_with("new report: expected at least 5 launches"));
    CHECK(complaint(few, enough).starts_with("old report: expected at least 5 launches"));
    Report uneven = enough;
    for (Sample& sample : uneven.scenes[0].runs[0].passes[2].samples) sample.launch = 0;
    CHECK(complaint(enough, uneven).find("resolve") != std::string::npos);
}

TEST_CASE("what differs is said, and what is not the same work is not compared") {
    Noise noise(7);
    const Report then = report({}, noise);
    Report now = report({}, noise);
    now.machine.processor = "another";
    now.machine.load = {3.5};
    now.scenes[0].runs[0].passes[3].limit = LimitKind::kArithmetic;
    now.scenes[0].runs[0].passes[4].limit_call = "around";
    now.scenes.push_back({.name = "attic"});
    now.scenes[0].runs.push_back({.threads = 9, .passes = now.scenes[0].runs[0].passes});
    now.scenes[1].runs = {now.scenes[0].runs[0]};
    const Comparison comparison = compare(then, now);
    CHECK(has(comparison.differences, "processor: one then, another now"));
    CHECK(has(comparison.differences, "room/threads:1/rays: limit"));
    CHECK(has(comparison.differences, "others kept 3.5 of 2 processors busy"));
    CHECK(has(comparison.left_out, "attic"));
    CHECK(has(comparison.left_out, "room/threads:9"));
    CHECK(has(comparison.left_out, "room/threads:1/shade: measured against another limit"));
    CHECK(comparison.passes.size() == std::size(kModels) - 1);
}

TEST_CASE("reports without anything in common are refused, with the reasons") {
    Noise noise(8);
    const Report then = report({}, noise);
    Report now = then;
    now.scenes[0].width = 1280;
    CHECK(complaint(then, now).find("size 640 x 360 then, 1280 x 360 now") != std::string::npos);
    now = then;
    now.scenes[0].name = "attic";
    CHECK(complaint(then, now).find("room: only in the old report") != std::string::npos);
}

TEST_CASE("groups, the remainder and what has no limit are not judged") {
    Noise noise(9);
    Report then = report({}, noise);
    std::vector<PassResult>& passes = then.scenes[0].runs[0].passes;
    passes[0].limit = LimitKind::kNone;
    passes[1].parts = {"setup"};
    passes[2].name = "other";
    CHECK(compare(then, then).passes.size() == std::size(kModels) - 3);
    CHECK_FALSE(reports_anything(compare(then, then)));
}
