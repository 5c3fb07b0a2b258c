#include "shadow/accumulate_kernel.h"

#include "core/simd/kernel.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

// Lane i is set where bit i is.
M lanes_from_bits(std::uint32_t word) {
    alignas(64) static constexpr std::uint32_t kLaneBits[16] = {
        1u << 0, 1u << 1, 1u << 2,  1u << 3,  1u << 4,  1u << 5,  1u << 6,  1u << 7,
        1u << 8, 1u << 9, 1u << 10, 1u << 11, 1u << 12, 1u << 13, 1u << 14, 1u << 15};
    const U lane_bits = simd::load<U>(kLaneBits);
    return (U(word) & lane_bits) == lane_bits;
}

void accumulate_lanes(const shadow::RayScratch& scratch, const LightSumsView& sums, int x, int y) {
    const M visible = lanes_from_bits(static_cast<std::uint32_t>(scratch.visible[y] >> x));
    for (int channel = 0; channel < 3; ++channel) {
        const F weight = simd::load<F>(scratch.weight[channel].row(y) + x);
        float* const shadowed = sums.shadowed[channel].row(y) + x;
        float* const unshadowed = sums.unshadowed_samples[channel].row(y) + x;
        simd::store(shadowed, simd::load<F>(shadowed) + simd::select(visible, weight, F(0)));
        simd::store(unshadowed, simd::load<F>(unshadowed) + weight);
    }
}

}  // namespace

void accumulate_rays(const shadow::RayScratch& scratch, const LightSumsView& sums) {
    constexpr std::uint64_t kOneBlock = (std::uint64_t(1) << kLanes) - 1;
    for (int y = 0; y < kTileSize; ++y)
        for (int x = 0; x < kTileSize; x += kLanes)
            if ((scratch.active[y] >> x) & kOneBlock) accumulate_lanes(scratch, sums, x, y);
}

}  // namespace penumbra::PENUMBRA_ISA
