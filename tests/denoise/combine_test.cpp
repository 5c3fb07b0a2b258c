#include <doctest/doctest.h>

#include "denoise/estimator.h"
#include "tests/denoise/test_frame.h"
#include "tests/lanes_agree.h"

namespace penumbra::denoise::tests {
namespace {

constexpr Estimator kEstimators[] = {Estimator::kRatio, Estimator::kStochastic,
                                     Estimator::kUnshadowed};

void run_combine(TestFrame& frame, Estimator estimator, const Run& run) {
    for_each_band(frame, run, [&](const PixelRect& band) {
        combine(frame.window, inputs_of(frame, estimator), outputs_of(frame), band, run.isa);
    });
}

TEST_CASE("W is held to [0, 1] and is 1 where nothing was learned") {
    CHECK(shadow_ratio(0.0f, 0.0f) == 1.0f);
    CHECK(shadow_ratio(1.0f, 4.0f) == 0.25f);
    CHECK(shadow_ratio(0.0f, 4.0f) == 0.0f);
    CHECK(shadow_ratio(4.0f, 1.0f) == 1.0f);
    CHECK(shadow_ratio(1e-30f, 1e-30f) == 1.0f);
    CHECK(raw_shadow_ratio(4.0f, 1.0f) == 4.0f);
}

TEST_CASE("each estimator ends as its equation says") {
    CHECK(finish(Estimator::kRatio, 1.0f, 2.0f, 1.0f, 4.0f) == 1.5f);
    CHECK(finish(Estimator::kRatio, 1.0f, 2.0f, 0.0f, 0.0f) == 3.0f);  // nothing learned
    CHECK(finish(Estimator::kStochastic, 1.0f, 2.0f, 0.25f, 4.0f) == 1.25f);
    CHECK(finish(Estimator::kUnshadowed, 1.0f, 2.0f, 0.25f, 4.0f) == 3.0f);
}

TEST_CASE("the picture is what the estimator makes, with the same bits for every number of lanes") {
    penumbra::tests::for_each_isa([&](simd::Isa isa) {
        for (const Estimator estimator : kEstimators) {
            TestFrame frame = make_test_frame(150, 80);
            run_combine(frame, estimator, {isa, 19});
            for_each_pixel(frame, [&](int i, int j) {
                for (std::size_t c = 0; c < 3; ++c) {
                    const float s = frame.shadowed[c].at(i, j);
                    const float u = frame.samples[c].at(i, j);
                    REQUIRE(same_bits(frame.ratio[c].at(i, j), shadow_ratio(s, u)));
                    REQUIRE(same_bits(frame.filtered_shadowed[c].at(i, j), s));
                    REQUIRE(same_bits(frame.filtered_samples[c].at(i, j), u));
                    REQUIRE(same_bits(frame.beauty[c].at(i, j),
                                      finish(estimator, frame.emission[c].at(i, j),
                                             frame.unshadowed[c].at(i, j), s, u)));
                }
            });
        }
    });
}

TEST_CASE("without noise the filter's picture is the plain one, whatever the estimator") {
    for (const Estimator estimator : kEstimators) {
        TestFrame plain = make_test_frame(150, 80);
        run_combine(plain, estimator, {});
        TestFrame filtered = make_test_frame(150, 80);
        filtered.noise.fill(0.0f);
        run_filter(filtered, {.noise = {}, .filter = {}, .estimator = estimator}, {});
        CHECK(count_differences(plain, plain.beauty, filtered.beauty) == 0);
    }
}

}  // namespace
}  // namespace penumbra::denoise::tests
