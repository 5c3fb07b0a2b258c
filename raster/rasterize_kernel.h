#pragma once

#include "raster/tile_memory.h"

// One tile: see raster/rasterize.h. Results are left in the tile memory's order of pixels.

namespace penumbra::avx2 {
void rasterize_tile(const raster::TileJob& job, raster::TileMemory& memory);
void count_tile_coverage(const raster::TileJob& job, raster::TileMemory& memory);
}  // namespace penumbra::avx2
namespace penumbra::avx512 {
void rasterize_tile(const raster::TileJob& job, raster::TileMemory& memory);
void count_tile_coverage(const raster::TileJob& job, raster::TileMemory& memory);
}  // namespace penumbra::avx512
