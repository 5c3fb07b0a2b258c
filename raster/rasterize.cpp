#include "raster/rasterize.h"

#include <algorithm>
#include <cstring>

#include "raster/rasterize_kernel.h"

namespace penumbra::raster {
namespace {

std::span<const std::uint32_t> references(const Geometry& geometry, const Bins::Part& part) {
    return {geometry.chunks[part.chunk].references.data() + part.begin, part.count};
}

TriangleRun make_run(const Geometry& geometry, int chunk_index,
                     std::span<const std::uint32_t> triangles) {
    const Chunk& chunk = geometry.chunks[chunk_index];
    return {.instance = &geometry.tables.instances[chunk.instance],
            .instance_index = static_cast<std::uint32_t>(chunk.instance),
            .references = triangles.data(),
            .count = static_cast<std::int32_t>(triangles.size()),
            .clipped = chunk.clipped.data(),
            .clipped_count = static_cast<std::int32_t>(chunk.clipped.size())};
}

// Merges the tile's own bin with that of its block: chunk by chunk, and in a chunk by triangle.
void gather_runs(const Geometry& geometry, Tile tile, Scratch& scratch) {
    const BinGrid& grid = geometry.bins.grid;
    const int x = (tile.x0 - geometry.tile_window.x0) / kTileSize;
    const int y = (tile.y0 - geometry.tile_window.y0) / kTileSize;
    const auto fine = geometry.bins.of(grid.tile_bin(x, y));
    const auto coarse = geometry.bins.of(grid.block_bin(x / kBlockTiles, y / kBlockTiles));
    scratch.runs.clear();
    scratch.merged.clear();
    std::size_t most_merged = 0;
    for (const Bins::Part& part : fine) most_merged += part.count;
    for (const Bins::Part& part : coarse) most_merged += part.count;
    scratch.merged.reserve(most_merged);  // runs point into it

    auto a = fine.begin();
    auto b = coarse.begin();
    while (a != fine.end() || b != coarse.end()) {
        const bool from_fine = b == coarse.end() || (a != fine.end() && a->chunk <= b->chunk);
        const bool from_coarse = a == fine.end() || (b != coarse.end() && b->chunk <= a->chunk);
        const int chunk = from_fine ? a->chunk : b->chunk;
        std::span<const std::uint32_t> triangles = references(geometry, from_fine ? *a : *b);
        if (from_fine && from_coarse) {
            const std::span<const std::uint32_t> others = references(geometry, *b);
            const std::size_t begin = scratch.merged.size();
            std::merge(triangles.begin(), triangles.end(), others.begin(), others.end(),
                       std::back_inserter(scratch.merged));
            triangles = std::span(scratch.merged).subspan(begin);
        }
        scratch.runs.push_back(make_run(geometry, chunk, triangles));
        if (from_fine) ++a;
        if (from_coarse) ++b;
    }
}

TileJob make_job(const SceneView& scene, const Geometry& geometry, Tile tile, Scratch& scratch) {
    gather_runs(geometry, tile, scratch);
    return {.camera = scene.camera,
            .tile = tile,
            .runs = scratch.runs.data(),
            .run_count = static_cast<int>(scratch.runs.size())};
}

// From cells to rows.
template <class T>
void unfold(const T* cells, PlaneView<T> plane) {
    for (int y = 0; y < kTileSize; ++y) {
        const T* from =
            cells + y / kCellSize * kCellsPerRow * kCellPixels + y % kCellSize * kCellSize;
        T* const row = plane.row(y);
        for (int x = 0; x < kTileSize; x += kCellSize, from += kCellPixels)
            std::memcpy(row + x, from, kCellSize * sizeof(T));
    }
}

}  // namespace

void rasterize(const SceneView& scene, const Geometry& geometry, Tile tile, simd::Isa isa,
               Scratch& scratch, VisibilityView visibility) {
    const TileJob job = make_job(scene, geometry, tile, scratch);
    simd::pick(isa, &avx2::rasterize_tile, &avx512::rasterize_tile)(job, scratch.memory);
    unfold(scratch.memory.instance, visibility.instance);
    unfold(scratch.memory.triangle, visibility.triangle);
}

void count_coverage(const SceneView& scene, const Geometry& geometry, Tile tile, simd::Isa isa,
                    Scratch& scratch, PlaneView<std::int32_t> front, PlaneView<std::int32_t> back) {
    const TileJob job = make_job(scene, geometry, tile, scratch);
    simd::pick(isa, &avx2::count_tile_coverage, &avx512::count_tile_coverage)(job, scratch.memory);
    unfold(scratch.memory.front, front);
    unfold(scratch.memory.back, back);
}

}  // namespace penumbra::raster
