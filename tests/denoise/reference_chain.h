#pragma once

#include <array>
#include <vector>

#include "tests/denoise/test_frame.h"

// The passes once more, in double, pixel by pixel, from their definitions: positions in space
// instead of plane equations, exp instead of recurrences, no blocks, no skipping.

namespace penumbra::denoise::tests {

using Image = std::vector<double>;  // width * height of the frame

// E of every pixel of a whole frame.
[[nodiscard]] Image reference_noise(const TestFrame& frame, const NoiseSettings& settings);

// S_N (channels 0 to 2) and U_N (3 to 5) after both passes, for the E in frame.noise.
[[nodiscard]] std::array<Image, 6> reference_filter(const TestFrame& frame,
                                                    const FilterSettings& settings);

}  // namespace penumbra::denoise::tests
