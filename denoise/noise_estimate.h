#pragma once

#include "core/frame/term.h"
#include "core/simd/isa.h"
#include "denoise/estimator.h"
#include "denoise/frame_window.h"
#include "denoise/scratch.h"
#include "denoise/settings.h"

namespace penumbra::denoise {

// The planes of the noise estimate: the term that it reads, and E, which it writes. All have one
// stride.
struct NoisePass {
    FrameWindow frame;
    ConstTermView term;      // U, S_N and U_N, finite and not negative; E is not read
    PlaneView<float> noise;  // E
    NoiseSettings settings;
    simd::Isa isa = simd::Isa::kAvx2;
    NoiseOf noise_of = NoiseOf::kShadow;
};

// E of the pixels of `band`: the noise of S_N / U_N, or of S_N / U, along four lines
// (noise_formula.h), smoothed by a 3x3 box. Of the former, E is 1 where nothing was learned
// although there is light (U_N = 0, U > 0): the filter then fills the pixel from as far as it may.
// band.x0 is a multiple of kBlock; whole blocks are written. Reads noise_margin() pixels around the
// band.
void estimate_noise(const NoisePass& pass, const PixelRect& band, Scratch& scratch);

}  // namespace penumbra::denoise
