#pragma once

#include <array>
#include <cstdint>

#include "core/frame/tile.h"

// The order in which a tile's rays are packed: squares of pixels along a Z curve, so that
// neighbours share a packet.

namespace penumbra::shadow {

// This many pixels a side: a row of a square is one 16-byte copy.
inline constexpr int kSquare = 4;
inline constexpr int kSquaresPerRow = kTileSize / kSquare;
inline constexpr int kSquares = kSquaresPerRow * kSquaresPerRow;
static_assert(kSquaresPerRow == 16);

struct SquarePlace {
    std::uint8_t x, y;  // pixels
};

constexpr std::array<SquarePlace, kSquares> squares_in_z_order() {
    std::array<SquarePlace, kSquares> places{};
    for (unsigned i = 0; i < kSquares; ++i) {
        unsigned x = 0, y = 0;
        for (unsigned bit = 0; bit < 4; ++bit) {
            x |= ((i >> (2 * bit)) & 1u) << bit;
            y |= ((i >> (2 * bit + 1)) & 1u) << bit;
        }
        places[i] = {static_cast<std::uint8_t>(kSquare * x),
                     static_cast<std::uint8_t>(kSquare * y)};
    }
    return places;
}
inline constexpr std::array<SquarePlace, kSquares> kSquaresInZOrder = squares_in_z_order();

}  // namespace penumbra::shadow
