#include <doctest/doctest.h>

#include "tests/denoise/test_frame.h"

// The filter of the stochastic estimate: S_N alone makes the picture, and the noise that drives the
// filter is that of S_N / U.

namespace penumbra::denoise::tests {
namespace {

const Settings kStochastic{
    .noise = {}, .filter = {}, .estimator = Estimator::kStochastic, .noise_of = NoiseOf::kLight};

// Nothing is blocked, but the samples' places are noisy: S_N = U_N, on average U.
void light_without_shadow(TestFrame& frame, float scale) {
    for_each_pixel(frame, [&](int i, int j) {
        const float sample = 0.5f + unit_random(i, j, 41);
        for (std::size_t c = 0; c < 3; ++c) {
            const float light = frame.unshadowed[c].at(i, j) * scale;
            frame.unshadowed[c].at(i, j) = light;
            frame.shadowed[c].at(i, j) = frame.samples[c].at(i, j) = light * sample;
        }
    });
}

double mean_noise(const TestFrame& frame) {
    double sum = 0;
    for_each_pixel(frame, [&](int i, int j) { sum += frame.noise.at(i, j); });
    return sum / (frame.width() * frame.height());
}

TEST_CASE("a filtered stochastic estimate is emission + the filtered S_N") {
    TestFrame frame = make_test_frame(150, 80);
    const TestFrame before = make_test_frame(150, 80);
    run_chain(frame, kStochastic);
    int changed = 0;
    for_each_pixel(frame, [&](int i, int j) {
        for (std::size_t c = 0; c < 3; ++c) {
            const float shadowed = frame.filtered_shadowed[c].at(i, j);
            REQUIRE(same_bits(frame.beauty[c].at(i, j), frame.emission[c].at(i, j) + shadowed));
            changed += !same_bits(shadowed, before.shadowed[c].at(i, j));
        }
    });
    CHECK(changed > 10000);
}

TEST_CASE("constant sums end as that constant, bit-unchanged, whatever the noise") {
    TestFrame frame = make_test_frame(150, 80);
    for_each_pixel(frame, [&](int i, int j) {
        frame.noise.at(i, j) = unit_random(i, j, 31);
        for (std::size_t c = 0; c < 3; ++c) {
            frame.samples[c].at(i, j) = 0.8f;
            frame.shadowed[c].at(i, j) = 0.37f;
        }
    });
    run_filter(frame, kStochastic, {});
    for_each_pixel(frame, [&](int i, int j) {
        for (std::size_t c = 0; c < 3; ++c)
            REQUIRE(same_bits(frame.beauty[c].at(i, j), frame.emission[c].at(i, j) + 0.37f));
    });
}

TEST_CASE("lit pixels have noise of the light where they have none of the shadow") {
    TestFrame frame = make_test_frame(150, 80);
    light_without_shadow(frame, 1);
    run_noise(frame, {}, {});
    CHECK(mean_noise(frame) == 0);
    run_noise(frame, kStochastic, {});
    CHECK(mean_noise(frame) > 0.3);
}

TEST_CASE("the noise of the light depends on neither brightness nor texture") {
    TestFrame bright = make_test_frame(150, 80);
    light_without_shadow(bright, 1);
    run_noise(bright, kStochastic, {});
    TestFrame dim = make_test_frame(150, 80);
    light_without_shadow(dim, 0x1p-12f);
    run_noise(dim, kStochastic, {});
    CHECK(count_differences(bright, bright.noise, dim.noise) == 0);

    TestFrame textured = make_test_frame(150, 80);
    for_each_pixel(textured, [&](int i, int j) {
        for (std::size_t c = 0; c < 3; ++c)
            textured.shadowed[c].at(i, j) = 0.5f * textured.unshadowed[c].at(i, j);
    });
    run_noise(textured, kStochastic, {});
    CHECK(mean_noise(textured) < 1e-3);
}

TEST_CASE("a pixel without samples is a dark sample of the stochastic estimate, not a gap") {
    TestFrame frame = make_test_frame(150, 80);
    for_each_pixel(frame, [&](int i, int j) {
        for (std::size_t c = 0; c < 3; ++c)
            frame.shadowed[c].at(i, j) = frame.samples[c].at(i, j) = 0;
    });
    run_noise(frame, {}, {});
    CHECK(mean_noise(frame) > 0.9);
    run_noise(frame, kStochastic, {});
    CHECK(mean_noise(frame) == 0);
}

}  // namespace
}  // namespace penumbra::denoise::tests
