#include "denoise/combine_kernel.h"

#include "core/simd/kernel.h"
#include "denoise/estimator.h"

namespace penumbra::PENUMBRA_ISA {

// Stores to a plane that may be missing.
static void store_if(const PlaneView<float>& plane, int x, int y, F value) {
    if (plane) simd::store(plane.row(y) + x, value);
}

// One channel of a row of elements, from x0 to x1.
static void combine_row(const denoise::CombineInputs& inputs,
                        const denoise::CombineOutputs& outputs, std::size_t channel, int y,
                        const PixelRect& elements) {
    const float* const shadowed = inputs.term.shadowed[channel].row(y);
    const float* const samples = inputs.term.unshadowed_samples[channel].row(y);
    const float* const unshadowed = inputs.term.unshadowed[channel].row(y);
    const float* const emission = inputs.emission[channel].row(y);
    float* const beauty = outputs.beauty[channel].row(y);
    for (int x = elements.x0; x < elements.x1; x += kLanes) {
        const F s = simd::load<F>(shadowed + x);
        const F u = simd::load<F>(samples + x);
        simd::store(beauty + x, denoise::finish(inputs.estimator, simd::load<F>(emission + x),
                                                simd::load<F>(unshadowed + x), s, u));
        if (outputs.ratio[channel])
            simd::store(outputs.ratio[channel].row(y) + x, denoise::shadow_ratio(s, u));
        store_if(outputs.shadowed[channel], x, y, s);
        store_if(outputs.unshadowed_samples[channel], x, y, u);
    }
}

void combine(const denoise::CombineInputs& inputs, const denoise::CombineOutputs& outputs,
             const PixelRect& elements) {
    for (int y = elements.y0; y < elements.y1; ++y)
        for (std::size_t channel = 0; channel < 3; ++channel)
            combine_row(inputs, outputs, channel, y, elements);
}

}  // namespace penumbra::PENUMBRA_ISA
