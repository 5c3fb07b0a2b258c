#pragma once

#include "core/frame/tile.h"
#include "raster/bins.h"
#include "raster/scene_tables.h"

namespace penumbra::raster {

// Triangles [first, first + count) of an instance. Both lists have room for `count` entries and a
// vector more, and are written in ascending order.
struct ClassifyJob {
    const InstanceTable* instance = nullptr;
    std::uint32_t first = 0;
    std::int32_t count = 0;
    PixelRect tile_window;  // whole tiles
    Candidate* candidates = nullptr;
    std::uint32_t* crossing = nullptr;  // triangles that cross the near plane or the guard band
};
struct ClassifyCounts {
    std::int32_t candidates = 0, crossing = 0;
};

}  // namespace penumbra::raster

namespace penumbra::avx2 {
raster::ClassifyCounts classify_triangles(const raster::ClassifyJob& job);
}
namespace penumbra::avx512 {
raster::ClassifyCounts classify_triangles(const raster::ClassifyJob& job);
}
