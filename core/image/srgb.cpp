#include "core/image/srgb.h"

#include <cmath>

namespace penumbra::image {
namespace {

constexpr int kGuesses = 4096;

// From a linear value's first guess, found by its 4096th, at most a few steps lead to the code
// whose interval holds it.
struct EncodeTable {
    std::array<float, 257> begins;                   // code c: [begins[c], begins[c + 1])
    std::array<std::uint8_t, kGuesses + 1> guesses;  // the code at i / 4096

    EncodeTable() {
        begins[0] = 0;
        begins[256] = 2;
        for (int code = 1; code < 256; ++code) {
            // The smallest float that rounds to this code.
            const double exact = linear_from_srgb((code - 0.5) / 255.0);
            float begin = static_cast<float>(exact);
            if (begin < exact) begin = std::nextafter(begin, 2.0f);
            begins[static_cast<std::size_t>(code)] = begin;
        }
        std::uint8_t code = 0;
        for (int i = 0; i <= kGuesses; ++i) {
            const float x = static_cast<float>(i) / kGuesses;
            while (begins[code + 1u] <= x) ++code;
            guesses[static_cast<std::size_t>(i)] = code;
        }
    }
};

}  // namespace

double linear_from_srgb(double coded) {
    return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
}

double srgb_from_linear(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

const std::array<std::uint16_t, 256>& linear16_from_srgb8() {
    static const std::array<std::uint16_t, 256> table = [] {
        std::array<std::uint16_t, 256> values{};
        for (std::size_t code = 0; code < 256; ++code) {
            values[code] = static_cast<std::uint16_t>(
                std::lround(65535 * linear_from_srgb(static_cast<double>(code) / 255)));
        }
        return values;
    }();
    return table;
}

std::uint8_t srgb8_from_linear(float linear) {
    static const EncodeTable table;
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    std::uint8_t code = table.guesses[static_cast<std::size_t>(linear * kGuesses)];
    while (table.begins[code + 1u] <= linear) ++code;
    return code;
}

}  // namespace penumbra::image
