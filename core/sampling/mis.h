#pragma once

#include "core/math/vec.h"

// Several techniques for one integral, each with a fixed number of samples.

namespace penumbra {

// The balance heuristic: Veach and Guibas, "Optimally Combining Sampling Techniques for Monte Carlo
// Rendering" (1995), section 3.3. A sample of either technique counts
//     integrand / (count_a density_a + count_b density_b),
// and the sum over all samples is the estimate: no further division by their number. This is the
// factor; 0 where neither technique can have drawn the sample.
template <class F>
F balance_factor(F count_a, const F& density_a, F count_b, const F& density_b) {
    const F expected = simd::fma(count_a, density_a, count_b * density_b);
    const auto possible = expected > F(0);
    return simd::select(possible, F(1) / simd::select(possible, expected, F(1)), F(0));
}

// How N samples of a light are shared out: all on the light up to 4, beyond that a quarter of them,
// rounded down, by the BRDF's visible normals. Few samples stay on the light, since a BRDF sample
// that misses it learns nothing about its shadow.
struct SampleShares {
    int light = 1;
    int brdf = 0;
};
inline constexpr int kMostSamplesOnLightOnly = 4;
[[nodiscard]] constexpr SampleShares share_samples(int samples) {
    const int brdf = samples > kMostSamplesOnLightOnly ? samples / 4 : 0;
    return {samples - brdf, brdf};
}

}  // namespace penumbra
