#include <doctest/doctest.h>

#include "denoise/joint_bilateral_formula.h"
#include "denoise/noise_formula.h"
#include "tests/denoise/test_frame.h"
#include "tests/lanes_agree.h"

// The formulas with F = float are the definition: the passes give their bits, with whatever they
// skip.

namespace penumbra::denoise::tests {
namespace {

constexpr int kWidth = 210;
constexpr int kHeight = 120;

// W_N with a border of unknown pixels, so that lines may leave the frame.
struct Ratios {
    static constexpr int kBorder = 16;
    static constexpr int kStride = kWidth + 2 * kBorder;
    explicit Ratios(const TestFrame& frame)
        : values(static_cast<std::size_t>(kStride) * (kHeight + 2 * kBorder), std::nanf("")) {
        for_each_pixel(frame, [&](int i, int j) {
            const auto color = [&](const Plane3<float>& p) {
                return Vec3f{p[0].at(i, j), p[1].at(i, j), p[2].at(i, j)};
            };
            *at(i, j) = luminance_ratio(color(frame.shadowed), color(frame.samples));
        });
    }
    float* at(int i, int j) { return values.data() + (j + kBorder) * kStride + i + kBorder; }
    std::vector<float> values;
};

void make_star(int rotation, int radius, StarOffsets& star) {
    for (int line = 0; line < kLines; ++line)
        for (int i = -radius; i <= radius; ++i) {
            float sine, cosine;
            sincos_two_pi((static_cast<float>(line) + static_cast<float>(rotation) / 16) / 8, sine,
                          cosine);
            const auto along = static_cast<float>(i);
            star[line][i + radius] = static_cast<int>(std::lrint(along * sine)) * Ratios::kStride +
                                     static_cast<int>(std::lrint(along * cosine));
        }
}

TEST_CASE("the noise estimate has the bits of its formula, evaluated everywhere") {
    TestFrame frame = make_test_frame(kWidth, kHeight);
    // A lit half, where the pass skips, and unlearned pixels in it.
    for_each_pixel(frame, [&](int i, int j) {
        for (std::size_t c = 0; c < 3 && i < 100; ++c)
            frame.shadowed[c].at(i, j) = frame.samples[c].at(i, j);
    });
    run_noise(frame, {}, {});
    Ratios ratios(frame);
    Plane<float> stars(kWidth, kHeight);
    for_each_pixel(frame, [&](int i, int j) {
        StarOffsets star;
        make_star(line_rotation(i, j), NoiseSettings{}.radius, star);
        stars.at(i, j) = star_noise<float>(ratios.at(i, j), star, {});
    });
    for (int j = 1; j < kHeight - 1; ++j)
        for (int i = 1; i < kWidth - 1; ++i) {
            const auto row = [&](int y) {
                return (stars.at(i - 1, y) + stars.at(i + 1, y)) + stars.at(i, y);
            };
            const bool is_gap = frame.samples[0].at(i, j) == 0 && frame.unshadowed[0].at(i, j) > 0;
            const float expected = is_gap ? 1.0f : ((row(j - 1) + row(j + 1)) + row(j)) / 9.0f;
            REQUIRE(same_bits(frame.noise.at(i, j), expected));
        }
}

// One pass of the filter over the pixels `radius` away from the frame's border.
Light<float> filtered(const TestFrame& frame, int i, int j, std::ptrdiff_t step,
                      const Vec3f& turn) {
    FilterSources at{};
    at.depth = &frame.depth.at(i, j);
    for (std::size_t c = 0; c < 3; ++c) {
        at.normal[c] = &frame.normal[c].at(i, j);
        at.shadowed[c] = &frame.shadowed[c].at(i, j);
        at.unshadowed_samples[c] = &frame.samples[c].at(i, j);
    }
    const FilterSettings settings;
    const float radius = gaussian_radius(frame.noise.at(i, j), *at.depth, settings);
    const Vec3f direction =
        frame.camera.direction(static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f);
    const auto centre = filter_centre(load_guide<float>(at, 0), radius, direction, turn, settings);
    return filtered_light(at, {settings.radius, settings.radius, step}, radius, centre, settings);
}

void check_channel(const Plane3<float>& found, const Vec3f& expected, int i, int j) {
    REQUIRE(same_bits(found[0].at(i, j), expected.x));
    REQUIRE(same_bits(found[1].at(i, j), expected.y));
    REQUIRE(same_bits(found[2].at(i, j), expected.z));
}

TEST_CASE("both filter passes have the bits of their formula") {
    const int margin = FilterSettings{}.radius;
    TestFrame before = make_test_frame(kWidth, kHeight);
    run_noise(before, {}, {});
    TestFrame after = make_test_frame(kWidth, kHeight);
    run_chain(after);  // leaves the horizontally filtered sums in its inputs
    const Camera& camera = before.camera;
    for (int j = margin; j < kHeight - margin; ++j)
        for (int i = margin; i < kWidth - margin; ++i) {
            const Light<float> row = filtered(before, i, j, 1, camera.right * (1 / camera.focal));
            check_channel(after.shadowed, row.shadowed, i, j);
            check_channel(after.samples, row.unshadowed_samples, i, j);
            const Light<float> column =
                filtered(after, i, j, after.depth.stride(), camera.up * (-1 / camera.focal));
            check_channel(after.filtered_shadowed, column.shadowed, i, j);
            check_channel(after.filtered_samples, column.unshadowed_samples, i, j);
        }
}

}  // namespace
}  // namespace penumbra::denoise::tests
