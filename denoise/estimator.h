#pragma once

#include "core/simd/lanes.h"

// How a pixel's U, S_N and U_N become its radiance: the one end of combine() and of every filter.

namespace penumbra::denoise {

enum class Estimator {
    // U W. Heitz, Hill and McGuire, "Combining Analytic Direct Illumination and Stochastic Shadows"
    // (2018), eq. 5. Where S_N and U_N are the same floats W is exactly 1, and the result U.
    kRatio,
    // S_N: plain Monte Carlo. Filtered, it is what the ratio has to be compared with, denoising the
    // stochastic estimate itself: textures and highlights are blurred with the noise, and lit
    // regions are noisy too.
    kStochastic,
    kUnshadowed,  // U
};

// What the noise that drives a filter is measured on. Both are numbers without a unit, so that the
// estimate's constants serve for both and dim scenes are as noisy as bright ones.
enum class NoiseOf {
    // W_N = S_N / U_N: the noise of visibility alone, for what is divided after the filter. It is 0
    // wherever nothing is blocked.
    kShadow,
    // S_N / U: all noise of the stochastic estimate, that of where the samples fell on the light
    // too, which S_N / U_N cancels; textures still cancel. Its mean is W. A pixel without samples
    // is a dark sample here and not an unknown one: S_N = 0 is what its estimate was.
    kLight,
};

// W = S_N / U_N before it is held to [0, 1]; 1 where nothing was learned.
template <class F>
F raw_shadow_ratio(F shadowed, F unshadowed_samples) {
    return simd::select(unshadowed_samples > F(0), shadowed / unshadowed_samples, F(1));
}

template <class F>
F shadow_ratio(F shadowed, F unshadowed_samples) {
    return simd::saturate(raw_shadow_ratio(shadowed, unshadowed_samples));
}

// The radiance of one channel: `emission` and what the estimator makes of U, S_N and U_N.
template <class F>
F finish(Estimator estimator, F emission, F unshadowed, F shadowed, F unshadowed_samples) {
    switch (estimator) {
        case Estimator::kRatio:
            return simd::fma(unshadowed, shadow_ratio(shadowed, unshadowed_samples), emission);
        case Estimator::kStochastic:
            return emission + shadowed;
        case Estimator::kUnshadowed:
            return emission + unshadowed;
    }
    return emission;
}

}  // namespace penumbra::denoise
