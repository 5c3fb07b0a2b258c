#include "core/image/crc32.h"

#include <array>
#include <cstring>

namespace penumbra::image {
namespace {

using Table = std::array<std::array<std::uint32_t, 256>, 8>;

// Row k advances a byte by k further zero bytes, so that eight bytes are folded in at once.
constexpr Table make_table() {
    Table table{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t remainder = byte;
        for (int bit = 0; bit < 8; ++bit) {
            remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? 0xEDB88320u : 0u);
        }
        table[0][byte] = remainder;
    }
    for (std::size_t k = 1; k < 8; ++k) {
        for (std::size_t byte = 0; byte < 256; ++byte) {
            const std::uint32_t before = table[k - 1][byte];
            table[k][byte] = (before >> 8) ^ table[0][before & 0xFF];
        }
    }
    return table;
}

constexpr Table kTable = make_table();

}  // namespace

std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
    std::uint32_t remainder = 0xFFFFFFFFu;
    while (bytes.size() >= 8) {
        std::uint32_t low, high;
        std::memcpy(&low, bytes.data(), 4);
        std::memcpy(&high, bytes.data() + 4, 4);
        low ^= remainder;
        remainder = 0;
        for (unsigned k = 0; k < 4; ++k) {
            remainder ^= kTable[7 - k][(low >> (8 * k)) & 0xFF];
            remainder ^= kTable[3 - k][(high >> (8 * k)) & 0xFF];
        }
        bytes = bytes.subspan(8);
    }
    for (const std::uint8_t byte : bytes) {
        remainder = (remainder >> 8) ^ kTable[0][(remainder ^ byte) & 0xFF];
    }
    return ~remainder;
}

}  // namespace penumbra::image
