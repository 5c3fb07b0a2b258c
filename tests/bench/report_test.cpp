#include <doctest/doctest.h>

#include "apps/bench/report.h"

using namespace penumbra;
using namespace penumbra::bench;

namespace {

PassResult pass(const std::string& name, double milliseconds) {
    return {.name = name,
            .work = {.pixels = 2'000'000, .rays = 1'000'000},
            .limit = LimitKind::kShadowRays,
            .samples = {{.milliseconds = milliseconds, .limit_milliseconds = milliseconds / 2},
                        {.milliseconds = milliseconds, .limit_milliseconds = milliseconds / 4}}};
}

ThreadRun run(int threads, double trace, double frame) {
    return {.threads = threads, .passes = {pass("trace", trace), pass("frame", frame)}};
}

}  // namespace

TEST_CASE("medians and quartiles interpolate between the sorted values") {
    const Summary even = summarize({4, 1, 3, 2});
    CHECK(even.median == doctest::Approx(2.5));
    CHECK(even.lower_quartile == doctest::Approx(1.75));
    CHECK(even.upper_quartile == doctest::Approx(3.25));
    CHECK(even.spread() == doctest::Approx(1.5));
    const Summary odd = summarize({9, 1, 5});
    CHECK(odd.median == 5);
    CHECK(odd.lowest == 1);
    CHECK(odd.highest == 9);
}

TEST_CASE("the deviation is that of a sample, and one value has none") {
    CHECK(summarize({2, 4}).deviation == doctest::Approx(1.4142135624));
    CHECK(summarize({2, 4}).variation() == doctest::Approx(1.4142135624 / 3));
    CHECK(summarize({7}).deviation == 0);
    CHECK(summarize({7}).median == 7);
}

TEST_CASE("a pass's fraction is taken with the limit of the same repetition") {
    const std::vector<double> both = fractions(pass("trace", 10));
    CHECK(both == std::vector<double>{0.5, 0.25});
    PassResult without = pass("evaluate", 10);
    without.limit = LimitKind::kNone;
    CHECK(fractions(without).empty());
}

TEST_CASE("throughput is work per second at the median, in each unit") {
    const Throughput t = throughput(pass("trace", 10));
    CHECK(t.pixels == doctest::Approx(2e8));
    CHECK(t.rays == doctest::Approx(1e8));
    CHECK(t.triangles == 0);
}

TEST_CASE("shares are parts of the whole frame, which is a run's last pass") {
    const ThreadRun one = run(1, 30, 100);
    CHECK(share(one, *find(one, "trace")) == doctest::Approx(0.3));
    CHECK(&whole_frame(one) == find(one, "frame"));
    CHECK(find(one, "nothing") == nullptr);
}

TEST_CASE("speed-up and efficiency refer to the run with the fewest threads, wherever it stands") {
    const SceneResult scene{.name = "s", .runs = {run(8, 5, 20), run(2, 15, 60), run(4, 10, 30)}};
    CHECK(speed_up(scene, scene.runs[0], "frame") == doctest::Approx(3));
    CHECK(efficiency(scene, scene.runs[0], "frame") == doctest::Approx(0.75));
    CHECK(speed_up(scene, scene.runs[1], "frame") == doctest::Approx(1));
    CHECK(efficiency(scene, scene.runs[2], "trace") == doctest::Approx(0.75));
}

TEST_CASE("benchmark names tell scene, threads and pass") {
    const SceneResult scene{.name = "sponza", .runs = {run(2, 1, 2)}};
    CHECK(benchmark_name(scene, scene.runs[0], scene.runs[0].passes[0]) ==
          "sponza/threads:2/trace");
}
