#pragma once

#include <cstddef>

#include "denoise/noise_estimate.h"
#include "denoise/noise_formula.h"

namespace penumbra::denoise {

// The estimate works on chunks that stay in the second-level cache: W_N of a chunk and its
// surroundings, then E before the box, both in scratch with this geometry. Element (0, 0) of the
// scratch planes is the pixel (chunk.x0 - kApronX, chunk.y0 - kApronY).
inline constexpr int kChunkWidth = 512;
inline constexpr int kChunkHeight = 64;
inline constexpr int kApronX = 2 * kBlock;  // a block for the box, which needs one for the lines
inline constexpr int kApronY = kBlock;
inline constexpr int kNoiseStride = kChunkWidth + 2 * kApronX;
inline constexpr int kNoiseRows = kChunkHeight + 2 * kApronY;
static_assert(kApronY >= kMaxLineRadius + 1 && kBlock >= kMaxLineRadius + 1);

// Square cells of kBlock pixels know the range of W_N in them, to skip what is constant all around.
inline constexpr int kCellColumns = kNoiseStride / kBlock;
inline constexpr int kCellRows = kNoiseRows / kBlock;
inline constexpr int kCells = kCellColumns * kCellRows;

constexpr std::size_t noise_scratch_size() {
    return 2 * static_cast<std::size_t>(kNoiseStride) * kNoiseRows + 2 * kCells * kBlock;
}

struct NoiseChunk {
    const NoisePass* pass;
    PlaneView3<const float> light;  // what S_N is divided by: U_N or U
    PixelRect chunk;                // elements of the planes, at most kChunkWidth x kChunkHeight
    PixelRect existing;             // elements that are pixels of the frame
    const StarOffsets* rotations;   // kRotations of them, for kNoiseStride
    float* ratio;                   // S_N / light, NaN where unknown or outside
    float* unsmoothed;              // E before the box, 0 outside
    float* lowest;                  // kBlock numbers per cell: the range of each column's W_N
    float* highest;
};

}  // namespace penumbra::denoise

namespace penumbra::avx2 {
void estimate_noise(const denoise::NoiseChunk& chunk);
}
namespace penumbra::avx512 {
void estimate_noise(const denoise::NoiseChunk& chunk);
}
