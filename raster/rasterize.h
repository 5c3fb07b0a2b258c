#pragma once

#include "core/frame/visibility.h"
#include "core/simd/isa.h"
#include "raster/setup.h"
#include "raster/tile_memory.h"

namespace penumbra::raster {

// What one thread needs to rasterize; used again tile after tile.
struct Scratch {
    TileMemory memory;
    std::vector<std::uint32_t> merged;  // references of a chunk that lie in fine and coarse bins
    std::vector<TriangleRun> runs;
};

// Finds the nearest triangle at each of the tile's kTileSize x kTileSize pixel centres.
//
// Coverage: a pixel belongs to a triangle if its centre is inside the snapped triangle or on a top
// or left edge of it: neighbours leave no gap and never cover a pixel twice. Exact, in integers.
// Depth: 1 / z is affine in the pixel position, (N . d) / (N . p0) for the plane of the unsnapped
// triangle and the direction d through the pixel (Olano and Greer, "Triangle Scan Conversion using
// 2D Homogeneous Coordinates", 1997, section 3), clamped to the triangle's own range. Of equal
// depths the lowest (instance, triangle) wins.
// Cutouts: core/scene/cutout.h.
//
// `tile` is one of those that `geometry` was prepared for.
void rasterize(const SceneView& scene, const Geometry& geometry, Tile tile, simd::Isa isa,
               Scratch& scratch, VisibilityView visibility);

// How often the triangles cover each pixel centre, whatever their depth and cutouts: front faces
// (those whose snapped vertices run counter-clockwise on the screen) in `front`, others in `back`.
void count_coverage(const SceneView& scene, const Geometry& geometry, Tile tile, simd::Isa isa,
                    Scratch& scratch, PlaneView<std::int32_t> front, PlaneView<std::int32_t> back);

}  // namespace penumbra::raster
