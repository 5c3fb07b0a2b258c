#pragma once

#include "core/frame/term.h"
#include "core/simd/isa.h"
#include "denoise/estimator.h"
#include "denoise/frame_window.h"

namespace penumbra::denoise {

// beauty = finish(emission, U, S_N, U_N) per channel: the whole of `--denoise none`, and what every
// filter ends in. Terms add up: the next one's `emission` is the beauty that the ones before it
// left, in place. All planes have one stride.
struct CombineInputs {
    ConstTermView term;
    PlaneView3<const float> emission;
    Estimator estimator = Estimator::kRatio;
};
struct CombineOutputs {
    PlaneView3<float> beauty;
    // For AOVs, each may be empty: W, of whatever estimator; S_N and U_N as the estimator saw them.
    PlaneView3<float> ratio;
    PlaneView3<float> shadowed;
    PlaneView3<float> unshadowed_samples;
};

// Writes the pixels of `band`, whose x0 is a multiple of kBlock; whole blocks are written, up to
// the planes' padding.
void combine(const FrameWindow& frame, const CombineInputs& inputs, const CombineOutputs& outputs,
             const PixelRect& band, simd::Isa isa);

}  // namespace penumbra::denoise
