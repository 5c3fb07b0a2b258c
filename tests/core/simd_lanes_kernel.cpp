#include "tests/core/simd_lanes_kernel.h"

#include "core/simd/kernel.h"

namespace penumbra::PENUMBRA_ISA {

void simd_lanes(const float* a, const float* b, const float* c, std::uint32_t* out, int count) {
    for (int i = 0; i < count; i += kLanes)
        tests::emit_lane_operations(simd::load<F>(a + i), simd::load<F>(b + i),
                                    simd::load<F>(c + i), tests::Emit<F>(out + i, count));
}

}  // namespace penumbra::PENUMBRA_ISA
