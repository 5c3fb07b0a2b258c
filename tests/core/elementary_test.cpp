#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/core/elementary_lanes_kernel.h"

namespace penumbra::tests {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
const float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kTwoPi = 6.283185307179586476925286766559;

double ulp(double exact) {
    const float rounded = std::max(std::fabs(static_cast<float>(exact)), 0x1p-126f);
    return static_cast<double>(std::nextafter(rounded, kInfinity)) - rounded;
}

// The largest error in ulp over [low, high]: a dense sweep, then every 1499th float of either sign.
// Errors up to `absolute` count as none.
template <class Function, class Exact>
double worst_ulp(const Function& function, const Exact& exact, float low, float high,
                 double absolute = 0) {
    double worst = 0;
    const auto test = [&](float x) {
        if (!(x >= low && x <= high)) return;
        const double expected = exact(static_cast<double>(x));
        const double error = std::fabs(function(x) - expected);
        if (!(error <= absolute)) worst = std::max(worst, error / ulp(expected));
    };
    constexpr int kSteps = 300000;
    for (int i = 0; i <= kSteps; ++i)
        test(low + (high - low) * (static_cast<float>(i) / static_cast<float>(kSteps)));
    for (std::uint32_t bits = 0x00800000u; bits < 0x7f800000u; bits += 1499) {
        test(simd::as_float(bits));
        test(-simd::as_float(bits));
    }
    return worst;
}

TEST_CASE("sine and cosine keep their bound up to 2^17" * doctest::test_suite("statistics")) {
    const auto sine = [](float x) { return sin(x); };
    const auto cosine = [](float x) { return cos(x); };
    const auto exact_sine = [](double x) { return std::sin(x); };
    const auto exact_cosine = [](double x) { return std::cos(x); };
    for (const float limit : {3.2f, 131072.0f}) {
        CHECK(worst_ulp(sine, exact_sine, -limit, limit, 0x1p-26) <= 2.0);
        CHECK(worst_ulp(cosine, exact_cosine, -limit, limit, 0x1p-26) <= 2.0);
    }
}

TEST_CASE("sine and cosine of turns keep their bound everywhere") {
    const auto turn = [](float x) {
        float sine, cosine;
        sincos_two_pi(x, sine, cosine);
        return std::pair(sine, cosine);
    };
    const auto angle = [](double x) { return kTwoPi * (x - std::nearbyint(x)); };
    CHECK(worst_ulp([&](float x) { return turn(x).first; },
                    [&](double x) { return std::sin(angle(x)); }, -3e38f, 3e38f, 0x1p-24) <= 2.0);
    CHECK(worst_ulp([&](float x) { return turn(x).second; },
                    [&](double x) { return std::cos(angle(x)); }, -3e38f, 3e38f, 0x1p-24) <= 2.0);
    CHECK(turn(0.25f) == std::pair(1.0f, 0.0f));
    CHECK(turn(0.5f) == std::pair(0.0f, -1.0f));
    CHECK(turn(-0.25f) == std::pair(-1.0f, 0.0f));
    CHECK(std::isnan(turn(kInfinity).first));
}

TEST_CASE("inverse functions keep their bounds") {
    CHECK(worst_ulp([](float x) { return acos(x); }, [](double x) { return std::acos(x); }, -1.0f,
                    1.0f) <= 1.5);
    CHECK(worst_ulp([](float x) { return atan(x); }, [](double x) { return std::atan(x); }, -3e38f,
                    3e38f) <= 2.0);
    std::mt19937 random(5);
    double worst = 0;
    for (int i = 0; i < 500000; ++i) {
        const float y = static_cast<float>(random()) - 2147483648.0f;
        const float x = static_cast<float>(random()) - 2147483648.0f;
        const double exact = std::atan2(static_cast<double>(y), static_cast<double>(x));
        worst = std::max(worst, std::fabs(atan2(y, x) - exact) / ulp(exact));
    }
    CHECK(worst <= 2.0);
}

TEST_CASE("exponentials and logarithms keep their bounds" * doctest::test_suite("statistics")) {
    CHECK(worst_ulp([](float x) { return exp2(x); }, [](double x) { return std::exp2(x); }, -126.0f,
                    127.9999f) <= 1.0);
    CHECK(worst_ulp([](float x) { return exp(x); }, [](double x) { return std::exp(x); }, -87.3365f,
                    88.7228f) <= 1.5);
    for (const auto& [low, high] : {std::pair(0x1p-126f, 3.4e38f), std::pair(0.5f, 2.0f)}) {
        CHECK(worst_ulp([](float x) { return log2(x); }, [](double x) { return std::log2(x); }, low,
                        high) <= 1.5);
        CHECK(worst_ulp([](float x) { return log(x); }, [](double x) { return std::log(x); }, low,
                        high) <= 1.5);
    }
}

TEST_CASE("the relative error of a power grows with its logarithm alone") {
    std::mt19937 random(7);
    double worst = 0;
    for (int i = 0; i < 500000; ++i) {
        const float x =
            simd::as_float(static_cast<std::uint32_t>(0x30000000u + random() % 0x20000000u));
        const float y = (static_cast<float>(random()) / 4294967296.0f - 0.5f) * 8.0f;
        const double logarithm = y * std::log2(static_cast<double>(x));
        if (std::fabs(logarithm) > 125) continue;
        const double error = std::fabs(pow(x, y) / std::exp2(logarithm) - 1);
        worst = std::max(worst, error / (1 + std::fabs(logarithm)));
    }
    CHECK(worst <= 0x1p-22);
}

TEST_CASE("elementary functions take their special values") {
    CHECK(std::isnan(sin(kInfinity)));
    CHECK(std::fabs(cos(1e30f)) <= 1.0f);
    CHECK(acos(1.5f) == 0.0f);
    CHECK(acos(-1.5f) == doctest::Approx(kTwoPi / 2).epsilon(1e-7));
    CHECK(exp2(128.0f) == kInfinity);
    CHECK(exp2(-126.0f) == 0x1p-126f);
    CHECK(exp2(-126.01f) == 0.0f);
    CHECK(exp2(3.0f) == 8.0f);
    CHECK(exp(88.73f) == kInfinity);
    CHECK(exp(-87.4f) == 0.0f);
    CHECK(exp(-kInfinity) == 0.0f);
    CHECK(exp(0.0f) == 1.0f);
    CHECK(log2(8.0f) == 3.0f);
    CHECK(log2(0.0f) == -kInfinity);
    CHECK(log(-0.0f) == -kInfinity);
    CHECK(std::isnan(log2(-1.0f)));
    CHECK(log(kInfinity) == kInfinity);
    for (const float nan :
         {sin(kNaN), cos(kNaN), acos(kNaN), atan(kNaN), exp2(kNaN), exp(kNaN), log2(kNaN),
          log(kNaN), atan2(kNaN, 1.0f), atan2(1.0f, kNaN), pow(kNaN, 2.0f)})
        CHECK(std::isnan(nan));
}

TEST_CASE("powers of 0, 1 and infinity are those of IEEE 754") {
    CHECK(pow(0.0f, 2.0f) == 0.0f);
    CHECK(pow(0.0f, -2.0f) == kInfinity);
    CHECK(pow(0.0f, 0.0f) == 1.0f);
    CHECK(pow(kNaN, 0.0f) == 1.0f);
    CHECK(pow(1.0f, kInfinity) == 1.0f);
    CHECK(pow(2.0f, 10.0f) == 1024.0f);
    CHECK(std::isnan(pow(-1.0f, 0.5f)));
}

TEST_CASE("the arc tangent of two arguments agrees with IEEE 754 at zeros and infinities") {
    const float values[] = {0.0f, -0.0f, 1.0f, -1.0f, kInfinity, -kInfinity};
    for (const float y : values)
        for (const float x : values) {
            const double exact = std::atan2(static_cast<double>(y), static_cast<double>(x));
            CHECK(std::fabs(atan2(y, x) - exact) <= 2 * ulp(exact));
            CHECK(std::signbit(atan2(y, x)) == std::signbit(exact));
        }
}

TEST_CASE("elementary functions give the bits of float, with 8 and with 16 lanes") {
    constexpr int kCount = 64000;
    const std::vector<float> a = lane_test_values(kCount, 1, 11);
    const std::vector<float> b = lane_test_values(kCount, kSpecialValueCount, 12);
    std::vector<std::uint32_t> expected(static_cast<std::size_t>(kElementaryResults) * kCount);
    for (std::size_t i = 0; i < kCount; ++i)
        emit_elementary_functions(a[i], b[i], Emit<float>(expected.data() + i, kCount));
    for_each_isa([&](simd::Isa isa) {
        std::vector<std::uint32_t> found(expected.size());
        simd::pick(isa, &avx2::elementary_lanes, &avx512::elementary_lanes)(a.data(), b.data(),
                                                                            found.data(), kCount);
        CAPTURE(simd::name(isa));
        CHECK(first_difference(expected, found, kCount) == "");
    });
}

}  // namespace
}  // namespace penumbra::tests
