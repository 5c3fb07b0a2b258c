#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/core/simd_lanes_kernel.h"

namespace penumbra::tests {
namespace {

constexpr int kCube = kSpecialValueCount * kSpecialValueCount * kSpecialValueCount;
constexpr int kCount = (kCube + 40000) / 16 * 16;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
const float kNaN = std::numeric_limits<float>::quiet_NaN();

struct Operands {
    std::vector<float> a = lane_test_values(kCount, 1, 1);
    std::vector<float> b = lane_test_values(kCount, kSpecialValueCount, 2);
    std::vector<float> c = lane_test_values(kCount, kSpecialValueCount* kSpecialValueCount, 3);
};

std::vector<std::uint32_t> results_of_float(const Operands& operands) {
    std::vector<std::uint32_t> out(static_cast<std::size_t>(kLaneResults) * kCount);
    for (std::size_t i = 0; i < kCount; ++i)
        emit_lane_operations(operands.a[i], operands.b[i], operands.c[i],
                             Emit<float>(out.data() + i, kCount));
    return out;
}

TEST_CASE("every lane operation gives the bits of float, with 8 and with 16 lanes") {
    const Operands operands;
    const std::vector<std::uint32_t> expected = results_of_float(operands);
    for_each_isa([&](simd::Isa isa) {
        std::vector<std::uint32_t> found(expected.size());
        simd::pick(isa, &avx2::simd_lanes, &avx512::simd_lanes)(
            operands.a.data(), operands.b.data(), operands.c.data(), found.data(), kCount);
        CAPTURE(simd::name(isa));
        CHECK(first_difference(expected, found, kCount) == "");
    });
}

TEST_CASE("min and max return the second operand where one is NaN or both are zeros") {
    CHECK(simd::min(kNaN, 2.0f) == 2.0f);
    CHECK(std::isnan(simd::min(2.0f, kNaN)));
    CHECK(simd::max(kNaN, 2.0f) == 2.0f);
    CHECK(std::isnan(simd::max(2.0f, kNaN)));
    CHECK(std::signbit(simd::min(0.0f, -0.0f)));
    CHECK_FALSE(std::signbit(simd::min(-0.0f, 0.0f)));
    CHECK(std::signbit(simd::max(0.0f, -0.0f)));
    CHECK_FALSE(std::signbit(simd::max(-0.0f, 0.0f)));
}

TEST_CASE("negation and absolute value touch the sign bit alone") {
    CHECK(std::signbit(-0.0f));
    CHECK_FALSE(std::signbit(simd::abs(-0.0f)));
    CHECK(simd::abs(-kInfinity) == kInfinity);
    CHECK(simd::copysign(2.0f, -0.0f) == -2.0f);
}

TEST_CASE("rounding is to the nearest integer, ties to even") {
    CHECK(simd::round(0.5f) == 0.0f);
    CHECK(simd::round(1.5f) == 2.0f);
    CHECK(simd::round(-2.5f) == -2.0f);
    CHECK(simd::floor(-0.5f) == -1.0f);
    CHECK(simd::to_int(-1.9f) == -1);
    CHECK(simd::to_int(kNaN) == std::numeric_limits<std::int32_t>::min());
    CHECK(simd::to_int(4e9f) == std::numeric_limits<std::int32_t>::min());
}

TEST_CASE("fma rounds once") {
    const float a = 1.0f + 0x1p-12f;  // a a = 1 + 2^-11 + 2^-24: the last term is lost in a product
    CHECK(simd::fma(a, a, -(1.0f + 0x1p-11f)) == 0x1p-24f);
}

TEST_CASE("denormal results are flushed to zero and denormal operands read as zero") {
    volatile float tiny = 0x1p-100f;
    volatile float denormal = 0x1p-130f;
    CHECK(simd::as_uint(tiny * tiny) == 0u);
    CHECK(simd::as_uint(denormal * 0x1p30f) == 0u);
    CHECK(simd::as_uint(simd::sqrt(float(denormal))) == 0u);
}

}  // namespace
}  // namespace penumbra::tests
