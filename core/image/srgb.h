#pragma once

#include <array>
#include <cstdint>

// The sRGB curve (IEC 61966-2-1).

namespace penumbra::image {

[[nodiscard]] double linear_from_srgb(double coded);
[[nodiscard]] double srgb_from_linear(double linear);

// The linear value of each 8-bit code as a 16-bit one: round(65535 * linear_from_srgb(code / 255)).
[[nodiscard]] const std::array<std::uint16_t, 256>& linear16_from_srgb8();

// The nearest 8-bit code: round(255 * srgb_from_linear(x)), x clamped to [0, 1], NaN gives 0.
[[nodiscard]] std::uint8_t srgb8_from_linear(float linear);

}  // namespace penumbra::image
