#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra::image {

// A zlib stream (RFC 1950, 1951) of the bytes, made for filtered pixels: fast before small. One
// candidate per hash, dynamic Huffman codes per block.
[[nodiscard]] std::vector<std::uint8_t> deflate(std::span<const std::uint8_t> bytes);

}  // namespace penumbra::image
