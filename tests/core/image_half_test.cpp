#include "core/image/half.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "core/image/half_kernel.h"
#include "core/simd/isa.h"
#include "tests/core/image_testing.h"

using namespace penumbra;
using namespace penumbra::image;

namespace {

double value_of(std::uint16_t half) {
    const int exponent = (half >> 10) & 31;
    const int mantissa = half & 1023;
    const double magnitude = exponent == 0    ? std::ldexp(mantissa, -24)
                             : exponent == 31 ? std::numeric_limits<double>::infinity()
                                              : std::ldexp(1024 + mantissa, exponent - 25);
    return (half & 0x8000) != 0 ? -magnitude : magnitude;
}

// Spread over all exponents that matter, with exact halves and midpoints of halves among them.
std::vector<float> interesting_floats() {
    Random random(4);
    std::vector<float> values;
    for (int i = 0; i < 40000; ++i) {
        const auto bits = static_cast<std::uint16_t>(random.below(0x7C00));
        const double low = value_of(bits);
        const double high =
            bits + 1 < 0x7C00 ? value_of(static_cast<std::uint16_t>(bits + 1)) : 65504;
        const double between[] = {low, 0.5 * (low + high), low + 0.3 * (high - low)};
        const double sign = random.below(2) == 0 ? 1 : -1;
        values.push_back(static_cast<float>(sign * between[i % 3]));
    }
    return values;
}

}  // namespace

TEST_CASE("halves are the nearest ones, ties to even, at any length of a row") {
    const std::vector<float> values = interesting_floats();
    std::vector<std::uint16_t> halves(values.size());
    const FloatCounts counts = convert_to_half(values, halves.data());
    CHECK(counts.clamped == 0);
    CHECK(counts.non_finite == 0);
    int wrong = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double error = std::fabs(value_of(halves[i]) - values[i]);
        for (const int step : {-1, 1}) {
            const auto next = static_cast<std::uint16_t>(halves[i] + step);
            if ((next & 0x7FFF) > 0x7BFF || (halves[i] & 0x7FFF) == 0) continue;
            const double other = std::fabs(value_of(next) - values[i]);
            wrong += other < error || (other == error && (halves[i] & 1) != 0);
        }
    }
    CHECK(wrong == 0);
    for (const std::size_t length : {0, 1, 7, 15, 16, 17, 33}) {
        std::vector<std::uint16_t> part(length + 1, 0xABCD);
        convert_to_half(std::span(values).first(length), part.data());
        CHECK(std::equal(part.begin(), part.end() - 1, halves.begin()));
        CHECK(part.back() == 0xABCD);
    }
}

TEST_CASE("halves have the same bits and counts on every instruction set") {
    if (!simd::is_supported(simd::Isa::kAvx512)) return;
    std::vector<float> values(1 << 16);
    Random random(5);
    for (float& value : values)
        value = std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
    std::vector<std::uint16_t> narrow(values.size()), wide(values.size());
    FloatCounts narrow_counts, wide_counts;
    avx2::convert_to_half(values.data(), narrow.data(), values.size(), narrow_counts);
    avx512::convert_to_half(values.data(), wide.data(), values.size(), wide_counts);
    CHECK(narrow == wide);
    CHECK(narrow_counts.clamped == wide_counts.clamped);
    CHECK(narrow_counts.non_finite == wide_counts.non_finite);
    std::size_t expected = 0;
    for (const float value : values) expected += std::isfinite(value) ? 0 : 1;
    CHECK(wide_counts.non_finite == expected);
    CHECK(count_non_finite(values) == expected);
    CHECK(count_non_finite(std::span(values).first(37)) <= 37);
}
