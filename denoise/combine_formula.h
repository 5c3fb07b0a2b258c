#pragma once

#include "core/simd/lanes.h"

namespace penumbra::denoise {

// W = S_N / U_N before it is held to [0, 1]; 1 where nothing was learned.
template <class F>
F raw_shadow_ratio(F shadowed, F unshadowed_samples) {
    return simd::select(unshadowed_samples > F(0), shadowed / unshadowed_samples, F(1));
}

template <class F>
F shadow_ratio(F shadowed, F unshadowed_samples) {
    return simd::saturate(raw_shadow_ratio(shadowed, unshadowed_samples));
}

// Radiance = emission + U W. Heitz, Hill and McGuire, "Combining Analytic Direct Illumination and
// Stochastic Shadows" (2018), eq. 5. Where S_N and U_N are the same floats W is exactly 1, and the
// result exactly emission + U.
template <class F>
F combined_radiance(F emission, F unshadowed, F ratio) {
    return simd::fma(unshadowed, ratio, emission);
}

}  // namespace penumbra::denoise
