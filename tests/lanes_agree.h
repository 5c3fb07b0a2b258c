#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/simd/isa.h"
#include "core/simd/lanes.h"
#include "tests/skip.h"

// Helpers for tests that demand equal bits from float, 8 and 16 lanes. The pattern: a templated
// body in a header writes its results through an Emit; the test calls it with `float`, a
// *_kernel.cpp with F; both fill arrays that must be equal. See tests/core/simd_lanes_kernel.h.

namespace penumbra::tests {

// Collects the results of one call of a body as bits: result n of element i goes to out[n * count +
// i]. All NaNs count as the same one: which operand's NaN survives is the compiler's choice.
template <class F>
class Emit {
  public:
    Emit(std::uint32_t* out, int count) : out_(out), count_(count) {}
    void number(F value) {
        const F quiet = simd::as_float(simd::UintOf<F>(0x7fc00000u));
        integer(simd::as_uint(simd::select(value != value, quiet, value)));
    }
    void integer(simd::UintOf<F> value) {
        simd::store(out_, value);
        out_ += count_;
    }
    void mask(simd::MaskOf<F> value) { number(simd::select(value, F(1), F(0))); }

  private:
    std::uint32_t* out_;
    int count_;
};

inline constexpr float kSpecialValues[] = {0.0f,
                                           -0.0f,
                                           1.0f,
                                           -1.0f,
                                           0.5f,
                                           -0.5f,
                                           1.5f,
                                           2.5f,
                                           -2.5f,
                                           0x1p-126f,
                                           -0x1p-126f,
                                           0x1p-149f,
                                           -0x1p-140f,
                                           3.4028235e38f,
                                           -3.4028235e38f,
                                           8388608.5f,
                                           2147483648.f,
                                           -2147483648.f,
                                           4294967296.f,
                                           __builtin_inff(),
                                           -__builtin_inff(),
                                           __builtin_nanf("")};

// `count` floats: the special values in every combination with a companion stream of another
// `stride`, then random bit patterns and random numbers of moderate size in turn.
inline std::vector<float> lane_test_values(int count, int stride, std::uint32_t seed) {
    constexpr int kSpecials = sizeof(kSpecialValues) / sizeof(float);
    std::mt19937 random(seed);
    std::vector<float> values(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        float& value = values[static_cast<std::size_t>(i)];
        if (i < kSpecials * kSpecials * kSpecials)
            value = kSpecialValues[i / stride % kSpecials];
        else if (i % 2 == 0)
            value = simd::as_float(static_cast<std::uint32_t>(random()));
        else
            value = (static_cast<float>(random()) / 4294967296.0f - 0.5f) * 16.0f;
    }
    return values;
}
inline constexpr int kSpecialValueCount = sizeof(kSpecialValues) / sizeof(float);

// Says in words where two result arrays first differ; empty if nowhere.
inline std::string first_difference(const std::vector<std::uint32_t>& expected,
                                    const std::vector<std::uint32_t>& found, int count) {
    for (std::size_t i = 0; i < expected.size(); ++i)
        if (expected[i] != found[i])
            return "result " + std::to_string(i / static_cast<std::size_t>(count)) +
                   " of element " + std::to_string(i % static_cast<std::size_t>(count)) +
                   ": expected bits " + std::to_string(expected[i]) + ", found " +
                   std::to_string(found[i]);
    return {};
}

// Calls run(isa) for each instruction set of this machine, and says which one it lacks.
template <class Run>
void for_each_isa(const Run& run) {
    for (const simd::Isa isa : {simd::Isa::kAvx2, simd::Isa::kAvx512}) {
        if (simd::is_supported(isa))
            run(isa);
        else
            report_skip(std::string(simd::name(isa)) + " is missing on this machine");
    }
}

}  // namespace penumbra::tests
