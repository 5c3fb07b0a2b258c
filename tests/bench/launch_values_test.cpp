#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "apps/bench/launch_values.h"

using namespace penumbra::bench;

namespace {

void add(PassResult& pass, int launch, double milliseconds, double limit, double floor,
         double limit_floor) {
    pass.samples.push_back({.milliseconds = milliseconds,
                            .limit_milliseconds = limit,
                            .launch = launch,
                            .floor_milliseconds = floor,
                            .limit_floor_milliseconds = limit_floor});
}

// From -1 to 1, the same on every machine.
double noise(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-52 - 1;
}

// Launches during which memory is now fast, now slow. The filter suffers from that by a third as
// much as streams do.
ThreadRun run(double memory, double filter_factor, std::mt19937_64& random) {
    PassResult rays{.name = "rasterize", .limit = LimitKind::kPrimaryRays};
    PassResult filter{.name = "filter", .limit = LimitKind::kStream};
    for (int launch = 0; launch < 12; ++launch) {
        const double condition = memory + 0.1 * noise(random);
        add(rays, launch, 3, 9, 3, 9);
        const double floor = 4 * filter_factor * std::exp(condition / 3 + 0.002 * noise(random));
        const double limit_floor = 2 * std::exp(condition);
        add(filter, launch, floor, limit_floor, floor, limit_floor);
    }
    return {.threads = 1, .passes = {rays, filter}};
}

double mean(const LaunchRatios& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("a launch is the floor of its pass over that of the limit") {
    PassResult pass{.name = "trace", .limit = LimitKind::kShadowRays};
    for (int launch = 0; launch < 5; ++launch)
        for (int i = 0; i < 5; ++i) add(pass, launch, 13.0 + launch + i, 5, 10, 4);
    const ThreadRun run{.threads = 1, .passes = {pass}};
    const LaunchValues values = steadiest_values(run, run, "trace");
    REQUIRE(values.then.size() == 5);
    CHECK(values.reference == LimitKind::kShadowRays);
    for (const double value : values.now) CHECK(value == doctest::Approx(std::log(2.5)));
}

TEST_CASE("without floors it is the median of the ratios") {
    // The machine runs at half speed for whole repetitions, which meets the limit as well.
    PassResult pass{.name = "filter", .limit = LimitKind::kStream};
    for (int launch = 0; launch < 5; ++launch)
        for (int i = 0; i < 5; ++i) {
            const double speed = (launch + i) % 5 == 0 || launch == 2 ? 2 : 1;
            add(pass, launch, 10 * speed, i == launch ? 5 * speed : 5.5 * speed, 0, 0);
        }
    const ThreadRun run{.threads = 1, .passes = {pass}};
    for (const double value : steadiest_values(run, run, "filter").now)
        CHECK(value == doctest::Approx(std::log(10 / 5.5)));
    pass.samples[0].milliseconds = pass.samples[1].milliseconds = pass.samples[2].milliseconds = 0;
    CHECK(median_ratios(pass).empty());
    CHECK(floor_ratios(pass, pass).empty());
}

TEST_CASE("a pass is held against the primary rays where its own limit is less steady") {
    PassResult rays{.name = "rasterize", .limit = LimitKind::kPrimaryRays};
    PassResult shade{.name = "shade", .limit = LimitKind::kArithmetic};
    for (int launch = 0; launch < 5; ++launch) {
        const double neighbours = 1 + 0.1 * launch;  // which the arithmetic does not notice
        add(rays, launch, 3, 9 * neighbours, 3, 9 * neighbours);
        add(shade, launch, 4 * neighbours, 2, 4 * neighbours, 2);
    }
    const ThreadRun run{.threads = 1, .passes = {rays, shade}};
    const LaunchValues values = steadiest_values(run, run, "shade");
    CHECK(values.reference == LimitKind::kPrimaryRays);
    for (const double value : values.then) CHECK(value == doctest::Approx(std::log(4.0 / 9)));
}

TEST_CASE("what goes with the conditions of the launches is taken away, a change is not") {
    std::mt19937_64 random(3);
    const ThreadRun then = run(0, 1, random);
    // Memory is 15 % slower throughout, and the filter got slower by 4 %.
    const ThreadRun now = run(0.15, 1.04, random);
    const LaunchValues values = steadiest_values(then, now, "filter");
    CHECK(values.reference == LimitKind::kPrimaryRays);
    CHECK(std::abs(mean(values.now) - mean(values.then) - std::log(1.04)) < 0.004);
    // Unadjusted it would seem to be 9 %.
    CHECK(mean(floor_ratios(now.passes[1], now.passes[0])) -
              mean(floor_ratios(then.passes[1], then.passes[0])) >
          0.08);
}

TEST_CASE("the adjustment is what least squares within the reports say, between 0 and 1") {
    const LaunchValues conditions{{1, 2, 3}, {10, 20}, LimitKind::kNone};
    // Slope 0.5 within both; the step of 100 between them stays.
    const LaunchValues half{{0.5, 1, 1.5}, {105, 110}, LimitKind::kNone};
    const LaunchValues level = adjusted(half, conditions);
    for (const double value : level.then) CHECK(value == doctest::Approx(0));
    for (const double value : level.now) CHECK(value == doctest::Approx(100));
    // Never more than all of them, nor the other way round.
    CHECK(adjusted({{3, 6, 9}, {30, 60}}, conditions).then[0] == doctest::Approx(2));
    CHECK(adjusted({{3, 2, 1}, {20, 10}}, conditions).then == std::vector<double>{3, 2, 1});
    // Conditions that are all alike explain nothing.
    CHECK(adjusted({{3, 2}, {1, 5}}, {{7, 7}, {8, 8}}).now == std::vector<double>{1, 5});
}
