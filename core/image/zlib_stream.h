#pragma once

#include <cstdint>
#include <span>
#include <vector>

// The one door to libdeflate: what PNG needs of zlib.

namespace penumbra::image {

// A zlib stream (RFC 1950) of the bytes: fast before small.
[[nodiscard]] std::vector<std::uint8_t> deflate(std::span<const std::uint8_t> bytes);

// The checksum of PNG chunks (ISO 3309).
[[nodiscard]] std::uint32_t crc32(std::span<const std::uint8_t> bytes);

}  // namespace penumbra::image
