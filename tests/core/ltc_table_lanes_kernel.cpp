#include "tests/core/ltc_table_lanes_kernel.h"

#include "core/simd/kernel.h"

namespace penumbra::PENUMBRA_ISA {

void ltc_lanes(const float* a, const float* b, std::uint32_t* out, int count) {
    for (int i = 0; i < count; i += kLanes)
        tests::emit_ltc_lookup(simd::load<F>(a + i), simd::load<F>(b + i),
                               tests::Emit<F>(out + i, count));
}

}  // namespace penumbra::PENUMBRA_ISA
