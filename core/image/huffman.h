#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra::image {

// A canonical prefix code of Deflate (RFC 1951, 3.2.2). Codes are stored with their first bit
// lowest, as the stream wants them.
struct HuffmanCode {
    std::vector<std::uint8_t> lengths;  // 0: the symbol does not occur
    std::vector<std::uint16_t> codes;
};

// A shortest code for these frequencies with no length beyond `longest` (at most 15). At least two
// symbols get a code, so that every decoder takes it.
[[nodiscard]] HuffmanCode make_huffman_code(std::span<const std::uint32_t> frequencies,
                                            int longest);

}  // namespace penumbra::image
