#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/frame/tile.h"
#include "core/parallel/arena.h"

// A window of the frame cut into tiles, and the loop over them.

namespace penumbra::parallel {

// The tiles that touch a window. They lie on the full frame's grid, so that a tile computes the
// same for every window that shows it; those at the window's edge reach beyond it.
struct TileGrid {
    explicit TileGrid(const PixelRect& window);

    [[nodiscard]] int count() const { return columns * rows; }
    // 0 <= index < count(), row by row.
    [[nodiscard]] Tile tile(int index) const;
    // The pixels of a tile that lie in the window.
    [[nodiscard]] PixelRect visible(const Tile& tile) const;

    PixelRect window;
    int x0 = 0, y0 = 0;  // top left of the first tile, full-frame pixels
    int columns = 0, rows = 0;
};

// In which order tiles are started. It changes no pixel: kShuffled is there to let tests show that.
struct TileOrder {
    enum class Kind { kRows, kMorton, kShuffled };
    Kind kind = Kind::kRows;
    std::uint32_t seed = 0;  // of kShuffled
};

// Each index of the grid once, in that order.
[[nodiscard]] std::vector<int> tile_sequence(const TileGrid& grid, const TileOrder& order);

// Calls body(tile, worker) once per tile; workers, exceptions and cancellation as in
// Arena::for_each.
void for_each_tile(const Arena& arena, const TileGrid& grid, const TileOrder& order,
                   const std::function<void(const Tile& tile, int worker)>& body,
                   const std::atomic<bool>* cancelled = nullptr);

}  // namespace penumbra::parallel
