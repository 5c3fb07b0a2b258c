#pragma once

#include "core/image/plane.h"
#include "core/simd/isa.h"
#include "denoise/frame_window.h"

namespace penumbra::denoise {

// beauty = emission + U * clamp(S_N / U_N, 0, 1) per channel, W = 1 where U_N = 0: the whole of
// `--denoise none`, and what every filter ends in. All planes have one stride.
struct CombineInputs {
    PlaneView3<const float> shadowed;            // S_N
    PlaneView3<const float> unshadowed_samples;  // U_N
    PlaneView3<const float> unshadowed;          // U
    PlaneView3<const float> emission;
};
struct CombineOutputs {
    PlaneView3<float> beauty;
    PlaneView3<float> ratio;  // W, for its AOV; may be empty
};

// Writes the pixels of `band`, whose x0 is a multiple of kBlock; whole blocks are written, up to
// the planes' padding.
void combine(const FrameWindow& frame, const CombineInputs& inputs, const CombineOutputs& outputs,
             const PixelRect& band, simd::Isa isa);

}  // namespace penumbra::denoise
