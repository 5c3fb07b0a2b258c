#include "apps/bench/arithmetic_kernel.h"

#include "core/simd/kernel.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

// Enough chains that none waits for its own last result: a fused multiply-add takes 4 cycles, and
// two start in each.
constexpr int kChains = 12;

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
    F all(0.0f);
    for (const F& sum : sums) all = all + sum;
    alignas(64) float lanes[kLanes];
    simd::store(lanes, all);
    float total = 0;
    for (const float lane : lanes) total += lane;
    return total;
}

}  // namespace penumbra::PENUMBRA_ISA
