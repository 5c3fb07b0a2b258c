#pragma once

#include "core/frame/camera.h"
#include "core/frame/term.h"
#include "core/simd/isa.h"
#include "denoise/combine.h"
#include "denoise/frame_window.h"
#include "denoise/scratch.h"
#include "denoise/settings.h"

namespace penumbra::denoise {

// What guides the filter. All planes of the filter have one stride.
struct FilterGuides {
    PlaneView<const float> depth;  // along the view axis
    // Unit, world, towards the viewer; 0 where nothing is hit. It spans the tangent plane that the
    // filter stays in: the geometric normal, for a shading normal would tilt that plane at every
    // bump.
    PlaneView3<const float> normal;
    Camera camera;
};

// The joint bilateral filter of S_N and U_N (joint_bilateral_formula.h), in two passes: first all
// rows horizontally, in place, then vertically into the picture. Where S_N and U_N are the same
// floats they stay so; 0 <= S_N <= U_N holds after each pass as before it, to the last bit;
// constants do not change. Pixels with U_N = 0 are filled.
//
// In place because a term's own S_N and U_N apart from the filtered ones are not free: filtering
// strips both ways in cache, the sums between in scratch, gives the same bits, but takes 3 to 7 %
// longer with 16 lanes (as long with 8), since it gives up streaming along whole rows. Who needs
// them afterwards keeps a copy.

struct HorizontalFilterPass {
    FrameWindow frame;
    FilterGuides guides;
    TermView term;  // S_N and U_N are replaced
    FilterSettings settings;
    simd::Isa isa = simd::Isa::kAvx2;
};

// Rows y0 <= y < y1 of the frame, over the window's whole width.
void filter_horizontally(const HorizontalFilterPass& pass, int y0, int y1, Scratch& scratch);

struct VerticalFilterPass {
    FrameWindow frame;
    FilterGuides guides;
    CombineInputs sums;  // the term's S_N and U_N are filtered horizontally
    CombineOutputs outputs;
    FilterSettings settings;
    simd::Isa isa = simd::Isa::kAvx2;
};

// The pixels of `band`, whose x0 is a multiple of kBlock; whole blocks are written. Reads
// vertical_filter_margin() pixels around the band.
void filter_vertically(const VerticalFilterPass& pass, const PixelRect& band);

}  // namespace penumbra::denoise
