#pragma once

#include "core/image/plane.h"

namespace penumbra {

// Tiles are squares of this many pixels, aligned to the full frame's top left, whatever the crop: a
// constant, since what a tile holds must not depend on the machine.
inline constexpr int kTileSize = 64;
static_assert(kTileSize % kRowPadding == 0);

// A window of the full frame's pixels, half-open.
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    [[nodiscard]] int width() const { return x1 - x0; }
    [[nodiscard]] int height() const { return y1 - y0; }
    [[nodiscard]] bool empty() const { return x1 <= x0 || y1 <= y0; }
    friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

// One tile: pixel (x0 + i, y0 + j) of the full frame is pixel (i, j) of the tile's views. Passes
// compute all kTileSize x kTileSize pixels, also those past the frame's edge; views have room for
// them.
struct Tile {
    int x0 = 0, y0 = 0;  // multiples of kTileSize, pixels of the full frame
    int index = 0;       // among the tiles of the frame's window, row by row
};

}  // namespace penumbra
