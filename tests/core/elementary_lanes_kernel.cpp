#include "tests/core/elementary_lanes_kernel.h"

#include "core/simd/kernel.h"

namespace penumbra::PENUMBRA_ISA {

void elementary_lanes(const float* a, const float* b, std::uint32_t* out, int count) {
    for (int i = 0; i < count; i += kLanes)
        tests::emit_elementary_functions(simd::load<F>(a + i), simd::load<F>(b + i),
                                         tests::Emit<F>(out + i, count));
}

}  // namespace penumbra::PENUMBRA_ISA
