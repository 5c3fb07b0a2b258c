#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/frame/tile.h"
#include "raster/snapped.h"

// Lists of triangles per tile. Triangles are sorted chunk by chunk, each chunk by one thread on its
// own; a bin is then the parts of chunks that fall on it, in the chunks' order. So the lists are in
// (instance, triangle) order by construction, and a reference costs 4 bytes.

namespace penumbra::raster {

inline constexpr int kChunkTriangles = 4096;
inline constexpr int kBlockTiles = 8;  // a coarse bin is a block of 8 x 8 tiles
// A triangle whose bounds touch more tiles than this goes to coarse bins.
inline constexpr int kMaxFineTiles = 16;

// The near plane and four sides of the guard band each add at most one vertex.
inline constexpr int kMaxClippedTriangleVertices = 8;

// The part of a triangle inside near plane and guard band; convex but for snapping.
struct ClippedTriangle {
    std::uint32_t triangle;
    std::int32_t vertex_count;  // 3 to kMaxClippedTriangleVertices
    SnappedVertex vertices[kMaxClippedTriangleVertices];
};

// A triangle that may cover pixels of the window, and the tiles its bounds touch (inclusive,
// counted from the window's first).
struct Candidate {
    std::uint32_t triangle;
    std::uint16_t x0, y0, x1, y1;
};

// Consecutive triangles of one instance, and those of them that may cover something, sorted by bin.
struct Chunk {
    struct Part {
        int bin;
        std::uint32_t begin, count;  // of `references`
    };
    int instance = 0;
    std::uint32_t first = 0, count = 0;     // triangles of the instance's mesh
    std::vector<std::uint32_t> references;  // triangle indices, ascending in each part
    std::vector<Part> parts;                // each bin at most once
    std::vector<ClippedTriangle> clipped;   // ascending triangles
};

// A grid of tiles and, after them, of blocks of tiles.
struct BinGrid {
    int tiles_x = 0, tiles_y = 0;
    [[nodiscard]] int blocks_x() const { return (tiles_x + kBlockTiles - 1) / kBlockTiles; }
    [[nodiscard]] int blocks_y() const { return (tiles_y + kBlockTiles - 1) / kBlockTiles; }
    [[nodiscard]] int tile_bin(int x, int y) const { return y * tiles_x + x; }
    [[nodiscard]] int block_bin(int x, int y) const {
        return tiles_x * tiles_y + y * blocks_x() + x;
    }
    [[nodiscard]] int bin_count() const { return tiles_x * tiles_y + blocks_x() * blocks_y(); }
};

struct Bins {
    struct Part {
        int chunk;
        std::uint32_t begin, count;  // of the chunk's references
    };
    BinGrid grid;
    std::vector<Part> parts;         // by bin, then by chunk
    std::vector<std::size_t> first;  // of each bin in `parts`, and the end

    [[nodiscard]] std::span<const Part> of(int bin) const {
        return {parts.data() + first[bin], parts.data() + first[bin + 1]};
    }
};

// Collects the references of one chunk and sorts them by bin.
class BinningScratch {
  public:
    void reset(int bin_count);
    void add(int bin, std::uint32_t triangle);
    void finish(Chunk& chunk);  // and is empty again

    [[nodiscard]] std::size_t allocated_bytes() const;

  private:
    struct Entry {
        int bin;
        std::uint32_t triangle;
    };
    std::vector<Entry> entries_;
    std::vector<std::uint32_t> counts_;  // per bin; all zero between chunks
    std::vector<int> touched_;           // bins with a count
};

// Makes the bins of all chunks.
void collect(std::span<const Chunk> chunks, const BinGrid& grid, Bins& bins);

}  // namespace penumbra::raster
