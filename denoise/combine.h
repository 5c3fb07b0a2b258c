#pragma once

#include "core/image/plane.h"
#include "core/simd/isa.h"
#include "denoise/estimator.h"
#include "denoise/frame_window.h"

namespace penumbra::denoise {

// beauty = finish(emission, U, S_N, U_N) per channel: the whole of `--denoise none`, and what every
// filter ends in. All planes have one stride.
struct CombineInputs {
    PlaneView3<const float> shadowed;            // S_N
    PlaneView3<const float> unshadowed_samples;  // U_N
    PlaneView3<const float> unshadowed;          // U
    PlaneView3<const float> emission;
    Estimator estimator = Estimator::kRatio;
};
struct CombineOutputs {
    PlaneView3<float> beauty;
    PlaneView3<float> ratio;  // W, of whatever estimator, for its AOV; may be empty
};

// Writes the pixels of `band`, whose x0 is a multiple of kBlock; whole blocks are written, up to
// the planes' padding.
void combine(const FrameWindow& frame, const CombineInputs& inputs, const CombineOutputs& outputs,
             const PixelRect& band, simd::Isa isa);

}  // namespace penumbra::denoise
