#include "apps/bench/arithmetic_kernel.h"

#include "core/simd/kernel.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

// Enough chains that none waits for its own last result: a fused multiply-add takes 4 cycles, and
// two start in each.
constexpr int kChains = 12;
// Likewise, of additions.
constexpr int kSums = 8;

template <int count>
float total(const F (&values)[count]) {
    F all(0.0f);
    for (const F& value : values) all = all + value;
    alignas(64) float lanes[kLanes];
    simd::store(lanes, all);
    float sum = 0;
    for (const float lane : lanes) sum += lane;
    return sum;
}

}  // namespace

int multiply_adds_per_round() {
    return kChains * kLanes;
}

float multiply_adds(long long rounds, float seed) {
    F sums[kChains];
    for (int i = 0; i < kChains; ++i) sums[i] = F(seed + static_cast<float>(i));
    const F factor(0.5f);
    const F offset(seed);
    for (long long round = 0; round < rounds; ++round)
        for (F& sum : sums) sum = simd::fma(sum, factor, offset);
    return total(sums);
}

float dependent_multiply_adds(int count, float seed) {
    F chain[1] = {F(seed)};
    const F factor(0.5f);
    const F offset(seed);
    for (int i = 0; i < count; ++i) chain[0] = simd::fma(chain[0], factor, offset);
    return total(chain);
}

float table_sums(const float* table, int floats, int rounds) {
    F sums[kSums];
    for (F& sum : sums) sum = F(0.0f);
    for (int round = 0; round < rounds; ++round)
        for (int first = 0; first < floats; first += kSums * kLanes)
            for (int k = 0; k < kSums; ++k)
                sums[k] = sums[k] + simd::load<F>(table + first + k * kLanes);
    return total(sums);
}

}  // namespace penumbra::PENUMBRA_ISA
