#include "core/compare/convolve_kernel.h"

#include "core/simd/kernel.h"

namespace penumbra::PENUMBRA_ISA {

void convolve(const float* from, std::ptrdiff_t step, const float* weights, int taps, float* to,
              int width) {
    for (int x = 0; x < width; x += kLanes) {
        F sum(0);
        for (int k = 0; k < taps; ++k)
            sum = simd::fma(F(weights[k]), simd::load<F>(from + x + k * step), sum);
        simd::store(to + x, sum);
    }
}

}  // namespace penumbra::PENUMBRA_ISA
