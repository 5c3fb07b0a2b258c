#pragma once

#include <cstdint>
#include <span>

namespace penumbra::image {

// The checksum of PNG chunks (ISO 3309).
[[nodiscard]] std::uint32_t crc32(std::span<const std::uint8_t> bytes);

}  // namespace penumbra::image
