#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/frame/frame_context.h"
#include "core/parallel/arena.h"
#include "core/scene/scene_view.h"
#include "raster/bins.h"
#include "raster/scene_tables.h"
#include "raster/snapped.h"

// From a scene to lists of triangles per tile: what a frame does once before its tiles.

namespace penumbra::raster {

// What one thread needs to sort a chunk.
struct ChunkScratch {
    BinningScratch binning;
    std::vector<Candidate> candidates;
    std::vector<std::uint32_t> crossing;
};

// What `prepare` leaves for the tiles of one frame. Owned by the caller and used again frame after
// frame, so that memory is allocated once. It points into the SceneView it was prepared from.
struct Geometry {
    PixelRect tile_window;  // the prepared window, grown to whole tiles
    SceneTables tables;
    std::vector<SnappedVertex> vertices;   // of all instances, see InstanceTable::snapped
    std::vector<Chunk> chunks;             // in (instance, triangle) order
    Bins bins;                             // per tile and per block of tiles: parts of chunks
    std::vector<ChunkScratch> of_workers;  // one per thread of the arena
};

// Transforms and snaps the vertices, drops the triangles that cannot cover a pixel of the window's
// tiles, and sorts the others into bins. Frames of up to 32767 x 32767 pixels. The lists are in
// (instance, triangle) order whatever the threads are.
void prepare(const SceneView& scene, const FrameContext& frame, PixelRect window,
             const parallel::Arena& arena, Geometry& geometry);

// Memory that `geometry` holds, in bytes.
[[nodiscard]] std::size_t allocated_bytes(const Geometry& geometry);

}  // namespace penumbra::raster
