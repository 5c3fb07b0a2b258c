#include "core/simd/kernel.h"
#include "tests/core/sampling_lanes.h"

namespace penumbra::PENUMBRA_ISA {

void sample_whole_row(SampledRow& row) {
    for (int first = 0; first < kSampledPixels; first += kLanes) sample_row<F>(row, first);
}

}  // namespace penumbra::PENUMBRA_ISA
