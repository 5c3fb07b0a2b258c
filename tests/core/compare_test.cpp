#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/compare/convolve_kernel.h"
#include "core/compare/error_sums.h"
#include "core/compare/flip.h"
#include "core/compare/flip_formula.h"
#include "core/compare/ssim.h"
#include "core/compare/transfer.h"
#include "core/image/srgb.h"
#include "core/simd/isa.h"
#include "tests/core/image_testing.h"
#include "tests/skip.h"

// The metrics' closed forms and invariants; their values on pictures are checked against other
// implementations in tests/diff/metrics_test.cpp.

namespace penumbra {
namespace {

using namespace compare;

constexpr Extent kExtent{37, 21, kFlipHalo};

float random_unit(Random& random) {
    return static_cast<float>(random.below(1 << 20)) / (1 << 20);
}

Plane<float> constant(float value) {
    Plane<float> plane = make_region(kExtent);
    plane.fill(value);
    return plane;
}

Plane3<float> constant(float r, float g, float b) {
    return {constant(r), constant(g), constant(b)};
}

Plane3<float> noise(std::uint64_t seed, float scale) {
    Random random(seed);
    Plane3<float> planes = constant(0, 0, 0);
    for (Plane<float>& plane : planes)
        for (int y = 0; y < kExtent.padded_height(); ++y)
            for (int x = 0; x < kExtent.padded_width(); ++x)
                plane.at(x, y) = scale * random_unit(random);
    return planes;
}

template <class Check>
void for_each_pixel(const Plane<float>& plane, const Check& check) {
    for (int y = 0; y < kExtent.height; ++y)
        for (int x = 0; x < kExtent.width; ++x) check(plane.at(x, y));
}

}  // namespace

TEST_CASE("FLIP is exactly 0 where pictures are equal, and near 1 between black and white") {
    Plane<float> errors(kExtent.width, kExtent.height);
    flip_map(noise(1, 1), noise(1, 1), kExtent, errors);
    for_each_pixel(errors, [](float error) { REQUIRE(error == 0.0f); });
    flip_map(constant(0, 0, 0), constant(1, 1, 1), kExtent, errors);
    for_each_pixel(errors, [](float error) { REQUIRE(std::abs(error - 0.97) < 0.03); });
}

TEST_CASE("FLIP between green and blue is 1: the farthest colours") {
    Plane<float> errors(kExtent.width, kExtent.height);
    flip_map(constant(0, 1, 0), constant(0, 0, 1), kExtent, errors);
    for_each_pixel(errors, [](float error) { REQUIRE(std::abs(error - 1) < 1e-4f); });
}

TEST_CASE("FLIP is symmetric") {
    Plane<float> forth(kExtent.width, kExtent.height), back(kExtent.width, kExtent.height);
    flip_map(noise(1, 1), noise(2, 1), kExtent, forth);
    flip_map(noise(2, 1), noise(1, 1), kExtent, back);
    for (int y = 0; y < kExtent.height; ++y)
        for (int x = 0; x < kExtent.width; ++x) REQUIRE(forth.at(x, y) == back.at(x, y));
}

TEST_CASE("exposures of HDR-FLIP show the brightest pixel and the median at 0.85") {
    const Exposures exposures = choose_exposures(0.2, 9.0);
    CHECK(display_from_scene(static_cast<float>(9.0 * std::exp2(exposures.start))) ==
          doctest::Approx(0.85));
    CHECK(display_from_scene(static_cast<float>(0.2 * std::exp2(exposures.stop))) ==
          doctest::Approx(0.85));
    CHECK(exposures.count == 6);  // log2(45) = 5.49
    CHECK(choose_exposures(1, 1).count == 1);
    CHECK(choose_exposures(0, 0).ev(0) == 0.0);
}

TEST_CASE("SSIM is exactly 1 where pictures are equal, and the luminance term between constants") {
    Plane<float> similarity(kExtent.width, kExtent.height);
    const Plane3<float> picture = noise(3, 1);
    ssim_map(picture[0], picture[0], kExtent, similarity);
    for_each_pixel(similarity, [](float s) { REQUIRE(s == 1.0f); });
    ssim_map(constant(0.2f), constant(0.6f), kExtent, similarity);
    const double expected = (2 * 0.2 * 0.6 + 1e-4) / (0.04 + 0.36 + 1e-4);
    for_each_pixel(similarity, [&](float s) { REQUIRE(std::abs(s - expected) < 1e-3); });
}

TEST_CASE("windows count where they lie in the picture whole, and all do where none could") {
    CHECK_FALSE(is_whole_window(4, 20));
    CHECK(is_whole_window(5, 20));
    CHECK(is_whole_window(14, 20));
    CHECK_FALSE(is_whole_window(15, 20));
    CHECK(is_whole_window(0, 10));
}

TEST_CASE("sums of errors are their definitions") {
    ErrorSums sums, rest;
    sums.add(1.0, 1.5);
    rest.add(2.0, 1.0);
    sums.add(rest);
    CHECK(sums.largest == 1.0);
    CHECK(sums.mae() == 0.75);
    CHECK(sums.rmse() == doctest::Approx(std::sqrt(0.625)));
    CHECK(sums.relmse() == doctest::Approx((0.25 / 1.01 + 1 / 4.01) / 2));
    CHECK(sums.psnr() == doctest::Approx(-10 * std::log10(0.625)));
    CHECK(std::isinf(ErrorSums{}.psnr()));
}

TEST_CASE("the sRGB curve of regions is the one of the image room") {
    const Plane3<float> linear = noise(7, 1.2f);
    const Plane3<float> coded = transfer(linear, Transfer::kEncodeSrgb, kExtent);
    const Plane3<float> back = transfer(coded, Transfer::kDecodeSrgb, kExtent);
    for (int y = 0; y < kExtent.height; ++y)
        for (int x = 0; x < kExtent.width; ++x) {
            const double v = std::min(static_cast<double>(linear[1].at(x, y)), 1.0);
            REQUIRE(std::abs(coded[1].at(x, y) - image::srgb_from_linear(v)) < 2e-6);
            REQUIRE(std::abs(back[1].at(x, y) - v) < 4e-6);
        }
}

TEST_CASE("filters have the same bits with 8 and 16 lanes") {
    if (!simd::is_supported(simd::Isa::kAvx512)) {
        tests::report_skip("no AVX-512");
        return;
    }
    const Plane3<float> picture = noise(9, 1);
    const float weights[] = {0.1f, 0.2f, 0.4f, 0.2f, 0.1f};
    std::vector<float> narrow(48), wide(48);
    avx2::convolve(picture[0].row(3), 1, weights, 5, narrow.data(), 48);
    avx512::convolve(picture[0].row(3), 1, weights, 5, wide.data(), 48);
    CHECK(narrow == wide);
}

}  // namespace penumbra
