#pragma once

#include <cstdint>

#include "core/frame/tile.h"
#include "core/simd/isa.h"

namespace penumbra {

// What identifies the samples of a pass: random numbers are a pure function of
// (pixel, sample, dimension, frame, seed) and of nothing else.
struct FrameContext {
    int width = 0, height = 0;  // the full frame, whatever the crop
    int frame = 0;
    int pass = 0;  // of --aa passes
    std::uint32_t seed = 0;
    simd::Isa isa = simd::Isa::kAvx2;
};

}  // namespace penumbra
