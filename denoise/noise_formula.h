#pragma once

#include <cstdint>
#include <limits>

#include "core/math/vec.h"
#include "denoise/frame_window.h"
#include "denoise/settings.h"

// The noise at a pixel: how much W_N = S_N / U_N wriggles along lines through it. Heitz, Hill and
// McGuire (2018), section 4.2: E is the total variation of the derivative of W along n lines,
// eq. 29. Differs: W is a luminance; pixels where nothing was learned (U_N = 0) and pixels outside
// of the frame belong to no second difference, and the sum over the rest is scaled up to the full
// number. For the stochastic estimate, U stands in the place of U_N (NoiseOf::kLight): that ratio
// may exceed 1, and E, which ends at 1, is the same formula.

namespace penumbra::denoise {

inline constexpr int kLines = 4;
inline constexpr int kRotations = 16;
inline constexpr int kMaxLinePoints = 2 * kMaxLineRadius + 1;

// Where the points of a line lie, as distances in a plane's elements.
using LineOffsets = std::int32_t[kMaxLinePoints];
using StarOffsets = LineOffsets[kLines];

// W_N of a pixel; NaN where nothing was learned. Exactly 1 where S_N and U_N are the same floats.
template <class F>
F luminance_ratio(const Vec3<F>& shadowed, const Vec3<F>& unshadowed_samples) {
    const F known = luminance(unshadowed_samples);
    return simd::select(known > F(0), luminance(shadowed) / known,
                        F(std::numeric_limits<float>::quiet_NaN()));
}

// E of one line, in [0, 1]: `ratio` points at the pixel's W_N.
template <class F>
F line_noise(const float* ratio, const LineOffsets& offsets, const NoiseSettings& settings) {
    const int points = 2 * settings.radius + 1;
    F before = simd::load<F>(ratio + offsets[0]);
    F here = simd::load<F>(ratio + offsets[1]);
    F variation = F(0);
    F known = F(0);
    for (int i = 2; i < points; ++i) {
        const F after = simd::load<F>(ratio + offsets[i]);
        const F bend = simd::abs(simd::fma(here, F(-2), before + after));
        variation += simd::max(bend, F(0));  // the second operand where the first is NaN
        known += simd::select(bend == bend, F(1), F(0));
        before = here;
        here = after;
    }
    const F scale = F(static_cast<float>(points - 2)) / simd::max(known, F(1));
    const F mean = variation * scale * F(1 / static_cast<float>(settings.radius));
    return simd::min(simd::sqrt(mean) * F(1 / settings.full_noise), F(1));
}

// E of a pixel before the 3x3 box.
template <class F>
F star_noise(const float* ratio, const StarOffsets& offsets, const NoiseSettings& settings) {
    F largest = F(0);
    F sum = F(0);
    for (int line = 0; line < kLines; ++line) {
        const F noise = line_noise<F>(ratio, offsets[line], settings);
        largest = simd::max(largest, noise);
        sum += noise;
    }
    return settings.rule == LineRule::kMaximum ? largest : sum * F(1.0f / kLines);
}

// Which rotation of the lines the 16x1 block of pixels at (x, y) of the full frame takes: an
// integer hash, multipliers from C. Wellons, hash-prospector (triple32).
inline int line_rotation(int x, int y) {
    std::uint32_t h =
        static_cast<std::uint32_t>(x / kBlock) + static_cast<std::uint32_t>(y) * 0x9e3779b9u;
    h ^= h >> 17;
    h *= 0xed5ad4bbu;
    h ^= h >> 11;
    h *= 0xac4c1b51u;
    h ^= h >> 15;
    return static_cast<int>(h % kRotations);
}

}  // namespace penumbra::denoise
