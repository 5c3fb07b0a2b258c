#include "denoise/combine.h"

#include "denoise/band.h"
#include "denoise/combine_kernel.h"

namespace penumbra::denoise {

void combine(const FrameWindow& frame, const CombineInputs& inputs, const CombineOutputs& outputs,
             const PixelRect& band, simd::Isa isa) {
    const PixelRect elements = band_elements(frame, band);
    simd::pick(isa, &avx2::combine, &avx512::combine)(inputs, outputs, elements);
}

}  // namespace penumbra::denoise
