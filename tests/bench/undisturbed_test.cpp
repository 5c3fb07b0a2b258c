#include <doctest/doctest.h>

#include <cmath>

#include "apps/bench/matched_runs.h"
#include "apps/bench/undisturbed.h"

using namespace penumbra::bench;

namespace {

// Two passes, whose milliseconds tell launch and repetition apart.
ThreadRun run(const std::vector<std::vector<double>>& shares_of_launches) {
    ThreadRun result{.threads = 1};
    result.passes.push_back({.name = "trace"});
    result.passes.push_back({.name = "frame"});
    for (std::size_t launch = 0; launch < shares_of_launches.size(); ++launch)
        for (std::size_t i = 0; i < shares_of_launches[launch].size(); ++i)
            for (PassResult& pass : result.passes)
                pass.samples.push_back({.milliseconds = static_cast<double>(10 * launch + i),
                                        .launch = static_cast<int>(launch),
                                        .core_share = shares_of_launches[launch][i]});
    return result;
}

std::vector<double> times(const ThreadRun& run) {
    std::vector<double> result;
    for (const Sample& sample : run.passes[0].samples) result.push_back(sample.milliseconds);
    CHECK(milliseconds(run.passes[1]) == result);
    return result;
}

std::vector<std::vector<double>> launches_of(int quiet, int disturbed) {
    std::vector<std::vector<double>> shares;
    for (int i = 0; i < disturbed; ++i) shares.push_back({2.0, 2.1, 2.0});
    for (int i = 0; i < quiet; ++i) shares.push_back({3.0, 3.0, 2.99});
    return shares;
}

}  // namespace

TEST_CASE("the best share is the upper decile: one that was measured wrong does not count") {
    std::vector<double> shares(20, 2.5);
    shares[7] = 4;
    shares[9] = 1;
    CHECK(best_core_share(run({shares})) == 2.5);
    CHECK(best_core_share(run({{0, 0, 0}})) == 0);
    CHECK(best_core_share(run({{3, 3, 3, 0}})) == 0);
    Report report;
    report.scenes.push_back({.name = "room", .runs = {run({shares})}});
    CHECK(best_core_share(report, "room", 1) == 2.5);
    CHECK(best_core_share(report, "room", 2) == 0);
    CHECK(best_core_share(report, "attic", 1) == 0);
}

TEST_CASE("undisturbed repetitions are kept, of launches that have at least three") {
    const ThreadRun all =
        run({{3, 2.9, 2, 3}, {3, 2, 3, 2}, {2, 2, 2, 2}, {2.86, 2.84, 2.86, 2.86}});
    const ThreadRun kept = undisturbed(all, 3);
    CHECK(times(kept) == std::vector<double>{0, 1, 3, 30, 32, 33});
    CHECK(launches(kept) == std::vector<int>{0, 3});
    CHECK(launches(all) == std::vector<int>{0, 1, 2, 3});
    // Where a launch has fewer than three, all of them must be.
    CHECK(times(undisturbed(run({{3, 3}, {3, 2}}), 3)) == std::vector<double>{0, 1});
    // A report that does not tell is as it is.
    CHECK(times(undisturbed(run({{0, 0}, {0}}), 0)) == std::vector<double>{0, 1, 10});
}

TEST_CASE("how often others used the cores is told, where they did") {
    CHECK(disturbance(run({{3, 2, 3}, {3, 2.9, 2.5}})) == "others used the cores in 2 of 6 frames");
    CHECK(disturbance(run({{3, 2.95}})).empty());
    CHECK(disturbance(run({{0, 0}})).empty());
}

TEST_CASE("the least disturbed repetitions stay in their order") {
    const ThreadRun all = run({{2, 3, 1, 2.5, 3}});
    CHECK(times(least_disturbed(all, 3)) == std::vector<double>{1, 3, 4});
    CHECK(times(least_disturbed(all, 9)).size() == 5);
    // Of equal ones the first.
    CHECK(times(least_disturbed(run({{0, 0, 0}}), 2)) == std::vector<double>{0, 1});
}

TEST_CASE("runs are compared by the launches with cores of their own, in their places") {
    const ThreadRun then = run(launches_of(6, 2));
    const ThreadRun now = run(launches_of(5, 1));
    const MatchedRuns runs = match(then, now, true);
    CHECK(runs.then.places == std::vector<std::size_t>{2, 3, 4, 5, 6, 7});
    CHECK(runs.now.places == std::vector<std::size_t>{1, 2, 3, 4, 5});
    CHECK(runs.note.starts_with("6 of 8 launches then and 5 of 6 now had cores of their own"));
    const Quantity quantity = runs.among_all({{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11}});
    REQUIRE(quantity.size() == 14);
    for (const std::size_t missing : {0, 1, 8}) CHECK(std::isnan(quantity[missing]));
    CHECK(quantity[2] == 1);
    CHECK(quantity[7] == 6);
    CHECK(quantity[9] == 7);
    CHECK(quantity[13] == 11);
}

TEST_CASE("where too few launches had cores of their own, all are compared") {
    const ThreadRun then = run(launches_of(8, 0));
    const MatchedRuns runs = match(then, run(launches_of(4, 4)), true);
    CHECK(runs.then.places.size() == 8);
    CHECK(runs.now.places.size() == 8);
    CHECK(runs.note.find("8 of 8 launches then and 4 of 8 now") != std::string::npos);
    CHECK(runs.note.find("--patience") != std::string::npos);
    CHECK(match(then, then, true).note.empty());
}

TEST_CASE("where a report does not tell the shares, all launches are compared") {
    const ThreadRun known = run(launches_of(5, 3));
    const ThreadRun unknown =
        run({{0, 0, 0}, {3, 3, 3}, {3, 3, 3}, {3, 3, 3}, {3, 3, 3}, {3, 3, 3}});
    for (const MatchedRuns& runs : {match(known, unknown, true), match(unknown, known, true)}) {
        CHECK(runs.note.starts_with("whether others used the cores was not measured"));
        CHECK(runs.then.places.size() == runs.then.all);
        CHECK(runs.now.places.size() == runs.now.all);
    }
    CHECK(disturbance(unknown).empty());
}

TEST_CASE("a report that was disturbed throughout is seen beside one that was not") {
    const ThreadRun quiet = run(launches_of(8, 0));
    const ThreadRun busy = run(launches_of(0, 8));
    CHECK(match(busy, busy, true).note.empty());  // by itself it cannot be
    CHECK(match(busy, quiet, true).note.starts_with("0 of 8 launches then and 8 of 8 now"));
    // Another processor has other shares.
    CHECK(match(busy, quiet, false).note.empty());
}
