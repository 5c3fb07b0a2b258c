#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

// 32-bit to 16-bit floats for files.

namespace penumbra::image {

inline constexpr float kLargestHalf = 65504.0f;

struct FloatCounts {
    std::size_t clamped = 0;     // finite and beyond +-65504
    std::size_t non_finite = 0;  // NaN or infinite
};

// Rounds to the nearest half, ties to even. Finite values beyond +-65504 become +-65504; infinities
// and NaN stay what they are: a defect of a picture must be found, not hidden.
FloatCounts convert_to_half(std::span<const float> from, std::uint16_t* to);

// NaN and infinities among the values.
[[nodiscard]] std::size_t count_non_finite(std::span<const float> values);

}  // namespace penumbra::image
