#pragma once

#include <cstdint>

#include "core/frame/tile.h"
#include "raster/bins.h"
#include "raster/scene_tables.h"

// What the tile kernels read and write.

namespace penumbra::raster {

// Pixels of a tile in 4 x 4 cells, so that one store of 16 lanes (two of 8) is a cell: cell after
// cell in rows, and row after row in a cell.
inline constexpr int kCellSize = 4;
inline constexpr int kCellPixels = kCellSize * kCellSize;
inline constexpr int kCellsPerRow = kTileSize / kCellSize;
inline constexpr int kTilePixels = kTileSize * kTileSize;

// Depth is tested first for groups of 2 x 2 cells.
inline constexpr int kGroupSize = 2 * kCellSize;
inline constexpr int kGroupsPerRow = kTileSize / kGroupSize;

struct alignas(64) TileMemory {
    float inverse_depth[kTilePixels];  // 1 / metres; 0 where nothing is hit
    std::uint32_t instance[kTilePixels];
    std::uint32_t triangle[kTilePixels];
    // A lower bound of the inverse depths in each group: what is farther is hidden.
    float farthest[kGroupsPerRow * kGroupsPerRow];
    std::int32_t writes[kGroupsPerRow * kGroupsPerRow];  // since `farthest` was computed
    // For count_coverage, in the same order of pixels.
    std::int32_t front[kTilePixels];
    std::int32_t back[kTilePixels];
};

// References of one chunk to triangles that may touch the tile, ascending.
struct TriangleRun {
    const InstanceTable* instance;
    std::uint32_t instance_index;
    const std::uint32_t* references;
    std::int32_t count;
    const ClippedTriangle* clipped;  // of the chunk, ascending triangles
    std::int32_t clipped_count;
};

struct TileJob {
    Camera camera;
    Tile tile;
    const TriangleRun* runs;
    int run_count;
};

}  // namespace penumbra::raster
