#include <doctest/doctest.h>

#include "denoise/noise_formula.h"
#include "tests/denoise/reference_chain.h"
#include "tests/lanes_agree.h"

namespace penumbra::denoise::tests {
namespace {

// W_N of every pixel of a frame, with light of one colour.
void set_shadow(TestFrame& frame, const std::function<float(int x, int y)>& visible) {
    for_each_pixel(frame, [&](int i, int j) {
        for (std::size_t c = 0; c < 3; ++c) {
            frame.samples[c].at(i, j) = 0.5f;
            frame.shadowed[c].at(i, j) = 0.5f * visible(i, j);
            frame.unshadowed[c].at(i, j) = 1.0f;
        }
    });
}

TEST_CASE("the noise estimate agrees with its definition in double") {
    TestFrame frame = make_test_frame(203, 131);
    for (const LineRule rule : {LineRule::kMaximum, LineRule::kMean})
        for (const int radius : {10, 4, kMaxLineRadius}) {
            const Settings settings{.noise = {.radius = radius, .rule = rule}, .filter = {}};
            run_noise(frame, settings, {});
            const Image expected = reference_noise(frame, settings.noise);
            double worst = 0;
            for_each_pixel(frame, [&](int i, int j) {
                const double e = expected[static_cast<std::size_t>(j * 203 + i)];
                worst = std::max(worst, std::fabs(frame.noise.at(i, j) - e));
            });
            // A square root of rounding errors of 1e-7.
            CHECK(worst < 1e-3);
        }
}

TEST_CASE("the noise estimate has the same bits for every number of lanes and every band") {
    TestFrame frame = make_test_frame(1100, 150);
    run_noise(frame, {}, {});
    penumbra::tests::for_each_isa([&](simd::Isa isa) {
        for (const int band_height : {1, 17, 64, 1000}) {
            TestFrame other = make_test_frame(1100, 150);
            run_noise(other, {}, {isa, band_height});
            CHECK(count_differences(frame, frame.noise, other.noise) == 0);
        }
    });
}

TEST_CASE("where the shadow is constant there is no noise, whatever the light does") {
    for (const float visible : {0.0f, 1.0f}) {
        TestFrame frame = make_test_frame(100, 70);
        for_each_pixel(frame, [&](int i, int j) {
            for (std::size_t c = 0; c < 3; ++c)
                frame.shadowed[c].at(i, j) = visible * frame.samples[c].at(i, j);
        });
        run_noise(frame, {}, {});
        for_each_pixel(frame, [&](int i, int j) {
            const bool is_gap = frame.samples[0].at(i, j) == 0 && frame.unshadowed[0].at(i, j) > 0;
            REQUIRE(frame.noise.at(i, j) == (is_gap ? 1.0f : 0.0f));
        });
    }
}

TEST_CASE("a linear penumbra without noise is little noise, a random one much") {
    TestFrame frame = make_test_frame(128, 64);
    set_shadow(frame, [](int x, int) { return static_cast<float>(x) / 128; });
    run_noise(frame, {}, {});
    CHECK(frame.noise.at(64, 32) <
          0.1f);  // lines on whole pixels are stairs, and see the slope a bit
    set_shadow(frame, [](int x, int y) { return unit_random(x, y, 7) < 0.5f ? 1.0f : 0.0f; });
    run_noise(frame, {}, {});
    CHECK(frame.noise.at(64, 32) > 0.6f);
    CHECK(frame.noise.at(0, 0) > 0.6f);  // a border is no reason to trust less or more
}

TEST_CASE("one deviating pixel is seen by its surroundings and by nobody else") {
    TestFrame frame = make_test_frame(128, 128);
    set_shadow(frame, [](int x, int y) { return x == 64 && y == 64 ? 0.0f : 1.0f; });
    run_noise(frame, {}, {});
    const int reach = noise_margin({}).x;
    CHECK(frame.noise.at(64, 64) > 0.1f);
    for_each_pixel(frame, [&](int i, int j) {
        if (std::abs(i - 64) > reach || std::abs(j - 64) > reach)
            REQUIRE(frame.noise.at(i, j) == 0.0f);
    });
}

TEST_CASE("noise does not depend on how bright the light is") {
    TestFrame bright = make_test_frame(150, 90);
    TestFrame dim = make_test_frame(150, 90);
    for (Plane3<float>* planes : {&dim.shadowed, &dim.samples, &dim.unshadowed})
        for_each_pixel(dim, [&](int i, int j) {
            for (std::size_t c = 0; c < 3; ++c) (*planes)[c].at(i, j) *= 0x1p-20f;
        });
    run_noise(bright, {}, {});
    run_noise(dim, {}, {});
    CHECK(count_differences(bright, bright.noise, dim.noise) == 0);
}

TEST_CASE("a line's noise is that of its definition, and its unknown points do not count") {
    float ratio[21];
    LineOffsets offsets{};
    for (int i = 0; i < 21; ++i) {
        ratio[i] = i % 2 == 0 ? 1.0f : 0.0f;
        offsets[i] = i - 10;
    }
    const NoiseSettings settings{.full_noise = 4};
    // 19 second differences of size 2.
    const float expected = std::sqrt(38.0f / 10) / 4;
    CHECK(line_noise<float>(ratio + 10, offsets, settings) == doctest::Approx(expected));
    ratio[5] = std::nanf("");
    CHECK(line_noise<float>(ratio + 10, offsets, settings) == doctest::Approx(expected));
    for (float& value : ratio) value = std::nanf("");
    CHECK(line_noise<float>(ratio + 10, offsets, settings) == 0.0f);
}

TEST_CASE("every rotation of the lines is used about equally often") {
    int uses[kRotations] = {};
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 1600; x += 16) ++uses[line_rotation(x, y)];
    for (const int count : uses) {
        CHECK(count > 500);
        CHECK(count < 750);
    }
    CHECK(line_rotation(16, 3) == line_rotation(31, 3));
}

}  // namespace
}  // namespace penumbra::denoise::tests
