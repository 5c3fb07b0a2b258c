#include "denoise/noise_estimate.h"

#include <algorithm>

#include "core/math/elementary.h"
#include "denoise/band.h"
#include "denoise/noise_estimate_kernel.h"

namespace penumbra::denoise {
namespace {

// Rotation k turns the star of lines by k / kRotations of the angle between two lines.
void make_offsets(int radius, StarOffsets* rotations) {
    for (int rotation = 0; rotation < kRotations; ++rotation)
        for (int line = 0; line < kLines; ++line) {
            const float half_turns =
                (static_cast<float>(line) + static_cast<float>(rotation) / kRotations) / kLines;
            float sine, cosine;
            sincos_two_pi(half_turns * 0.5f, sine, cosine);
            for (int i = -radius; i <= radius; ++i) {
                const auto along = static_cast<float>(i);
                const int dx = simd::to_int(simd::round(along * cosine));
                const int dy = simd::to_int(simd::round(along * sine));
                rotations[rotation][line][i + radius] = dy * kNoiseStride + dx;
            }
        }
}

}  // namespace

void estimate_noise(const NoisePass& pass, const PixelRect& band, Scratch& scratch) {
    PENUMBRA_ASSERT(pass.settings.radius >= 2 && pass.settings.radius <= kMaxLineRadius,
                    "radius = {}", pass.settings.radius);
    PENUMBRA_ASSERT(scratch.size() >= noise_scratch_size(), "{} floats", scratch.size());
    StarOffsets rotations[kRotations];
    make_offsets(pass.settings.radius, rotations);
    constexpr std::size_t kPlane = static_cast<std::size_t>(kNoiseStride) * kNoiseRows;
    const ConstTermView& term = pass.term;
    NoiseChunk chunk{
        .pass = &pass,
        .light = pass.noise_of == NoiseOf::kLight ? term.unshadowed : term.unshadowed_samples,
        .chunk = {},
        .existing = existing_elements(pass.frame),
        .rotations = rotations,
        .ratio = scratch.data(),
        .unsmoothed = scratch.data() + kPlane,
        .lowest = scratch.data() + 2 * kPlane,
        .highest = scratch.data() + 2 * kPlane + kCells * kBlock};
    const PixelRect elements = band_elements(pass.frame, band);
    for (int y = elements.y0; y < elements.y1; y += kChunkHeight)
        for (int x = elements.x0; x < elements.x1; x += kChunkWidth) {
            chunk.chunk = {x, y, std::min(x + kChunkWidth, elements.x1),
                           std::min(y + kChunkHeight, elements.y1)};
            simd::pick(pass.isa, &avx2::estimate_noise, &avx512::estimate_noise)(chunk);
        }
}

}  // namespace penumbra::denoise
