#include "raster/setup.h"

#include <algorithm>

#include "core/error.h"
#include "core/simd/isa.h"
#include "raster/classify_kernel.h"
#include "raster/clip.h"
#include "raster/edges.h"
#include "raster/project_kernel.h"

namespace penumbra::raster {
namespace {

constexpr int kMaxLanes = 16;
constexpr int kVerticesPerTask = 16384;
static_assert(kVerticesPerTask % kMaxLanes == 0);

std::size_t rounded_up_to_vectors(std::size_t count) {
    return (count + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
}

PixelRect whole_tiles(const PixelRect& window) {
    const auto down = [](int x) { return x / kTileSize * kTileSize; };
    const auto up = [&](int x) { return down(x + kTileSize - 1); };
    return {down(window.x0), down(window.y0), up(window.x1), up(window.y1)};
}

// ---- vertices --------------------------------------------------------------------------------

void project_all(const SceneView& scene, simd::Isa isa, const parallel::Arena& arena,
                 Geometry& geometry) {
    std::size_t total = 0;
    for (const Instance& instance : scene.instances)
        total += rounded_up_to_vectors(instance.mesh->positions.size());
    geometry.vertices.resize(total);

    std::vector<ProjectJob> jobs;
    SnappedVertex* next = geometry.vertices.data();
    for (InstanceTable& table : geometry.tables.instances) {
        table.snapped = next;
        for (std::int32_t begin = 0; begin < table.vertex_count; begin += kVerticesPerTask)
            jobs.push_back({.camera = scene.camera,
                            .positions = table.positions,
                            .vertex_count = table.vertex_count,
                            .begin = begin,
                            .end = std::min(begin + kVerticesPerTask, table.vertex_count),
                            .snapped = next});
        next += rounded_up_to_vectors(static_cast<std::size_t>(table.vertex_count));
    }
    const auto project = simd::pick(isa, &avx2::project_vertices, &avx512::project_vertices);
    arena.for_each(static_cast<int>(jobs.size()), [&](int job, int) { project(jobs[job]); });
}

// ---- bins of one chunk -----------------------------------------------------------------------

// Does a snapped triangle of positive area reach any pixel centre of a rectangle? May say yes
// where no centre is covered, never no where one is.
bool may_touch(const SnappedVertex (&v)[3], const PixelRect& pixels) {
    const std::int64_t x0 = pixel_center(pixels.x0), x1 = pixel_center(pixels.x1 - 1);
    const std::int64_t y0 = pixel_center(pixels.y0), y1 = pixel_center(pixels.y1 - 1);
    for (int k = 0; k < 3; ++k) {
        const SnappedVertex& a = v[k];
        const SnappedVertex& b = v[(k + 1) % 3];
        const std::int64_t dx = std::int64_t{b.x} - a.x;
        const std::int64_t dy = std::int64_t{b.y} - a.y;
        const std::int64_t largest =
            dx * ((dx > 0 ? y1 : y0) - a.y) - dy * ((dy > 0 ? x0 : x1) - a.x);
        if (largest < 0) return false;
    }
    return true;
}

// The snapped vertices in the order that makes the area positive.
void load_oriented(const InstanceTable& table, std::uint32_t triangle, SnappedVertex (&v)[3]) {
    const std::int32_t* const vertices = table.vertices + std::size_t{triangle} * 3;
    for (int k = 0; k < 3; ++k) v[k] = table.snapped[vertices[k]];
    if (doubled_area<std::int64_t>(v[0].x, v[0].y, v[1].x, v[1].y, v[2].x, v[2].y) < 0)
        std::swap(v[1], v[2]);
}

class ChunkSorter {
  public:
    ChunkSorter(const Geometry& geometry, const InstanceTable& table, BinningScratch& binning)
        : window_(geometry.tile_window),
          grid_(geometry.bins.grid),
          table_(table),
          binning_(binning) {}

    void add(const Candidate& c, bool is_clipped) {
        const int tiles = (c.x1 - c.x0 + 1) * (c.y1 - c.y0 + 1);
        if (tiles == 1) return binning_.add(grid_.tile_bin(c.x0, c.y0), c.triangle);
        // A row of tiles that the bounds touch, the triangle touches too, all but always.
        const bool test_each = !is_clipped && c.x1 > c.x0 && c.y1 > c.y0;
        SnappedVertex v[3] = {};
        if (test_each) load_oriented(table_, c.triangle, v);
        const int size = tiles <= kMaxFineTiles ? 1 : kBlockTiles;
        for (int y = c.y0 / size; y <= c.y1 / size; ++y)
            for (int x = c.x0 / size; x <= c.x1 / size; ++x)
                if (!test_each || may_touch(v, pixels_of(x, y, size)))
                    binning_.add(size == 1 ? grid_.tile_bin(x, y) : grid_.block_bin(x, y),
                                 c.triangle);
    }

  private:
    [[nodiscard]] PixelRect pixels_of(int x, int y, int tiles) const {
        const int pixels = tiles * kTileSize;
        const int x0 = window_.x0 + x * pixels;
        const int y0 = window_.y0 + y * pixels;
        return {x0, y0, x0 + pixels, y0 + pixels};
    }

    PixelRect window_;
    BinGrid grid_;
    const InstanceTable& table_;
    BinningScratch& binning_;
};

// ---- triangles that cross the clip planes ----------------------------------------------------

// Where the polygon's bounds lie among the window's tiles; false: nowhere.
bool tiles_of(const ClippedTriangle& polygon, const PixelRect& window, Candidate& candidate) {
    SnappedVertex low = polygon.vertices[0], high = low;
    for (int k = 1; k < polygon.vertex_count; ++k) {
        const SnappedVertex& v = polygon.vertices[k];
        low = {std::min(low.x, v.x), std::min(low.y, v.y)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y)};
    }
    const int x0 = std::max(first_pixel(low.x), window.x0);
    const int y0 = std::max(first_pixel(low.y), window.y0);
    const int x1 = std::min(last_pixel(high.x), window.x1 - 1);
    const int y1 = std::min(last_pixel(high.y), window.y1 - 1);
    if (x0 > x1 || y0 > y1) return false;
    const auto tile = [](int pixel, int origin) {
        return static_cast<std::uint16_t>((pixel - origin) / kTileSize);
    };
    candidate = {polygon.triangle, tile(x0, window.x0), tile(y0, window.y0), tile(x1, window.x0),
                 tile(y1, window.y0)};
    return true;
}

// The clipped polygon of a triangle and its tiles; false where nothing of it is in the window.
bool clip_candidate(const SceneView& scene, const Geometry& geometry, const Chunk& chunk,
                    ClippedTriangle& polygon, Candidate& candidate) {
    const Instance& instance = scene.instances[chunk.instance];
    const Triangle& triangle = instance.mesh->triangles[polygon.triangle];
    Vec3f view[3];
    for (int k = 0; k < 3; ++k)
        view[k] = scene.camera.view_from_world(instance.positions[triangle.vertex[k]]);
    polygon.vertex_count = clip_triangle(scene.camera, view, polygon.vertices);
    return polygon.vertex_count > 0 && tiles_of(polygon, geometry.tile_window, candidate);
}

void sort_chunk(const SceneView& scene, simd::Isa isa, const Geometry& geometry,
                ChunkScratch& scratch, Chunk& chunk) {
    const InstanceTable& table = geometry.tables.instances[chunk.instance];
    scratch.candidates.resize(kChunkTriangles + kMaxLanes);
    scratch.crossing.resize(kChunkTriangles + kMaxLanes);
    const auto classify = simd::pick(isa, &avx2::classify_triangles, &avx512::classify_triangles);
    const ClassifyCounts counts = classify({.instance = &table,
                                            .first = chunk.first,
                                            .count = static_cast<std::int32_t>(chunk.count),
                                            .tile_window = geometry.tile_window,
                                            .candidates = scratch.candidates.data(),
                                            .crossing = scratch.crossing.data()});
    chunk.clipped.clear();
    ChunkSorter sorter(geometry, table, scratch.binning);
    const Candidate* next = scratch.candidates.data();
    const Candidate* const end = next + counts.candidates;
    for (int k = 0; k < counts.crossing; ++k) {
        ClippedTriangle polygon{scratch.crossing[k], 0, {}};
        Candidate candidate;
        if (!clip_candidate(scene, geometry, chunk, polygon, candidate)) continue;
        while (next != end && next->triangle < polygon.triangle) sorter.add(*next++, false);
        sorter.add(candidate, true);
        chunk.clipped.push_back(polygon);
    }
    while (next != end) sorter.add(*next++, false);
    scratch.binning.finish(chunk);
}

void make_chunks(const SceneView& scene, std::vector<Chunk>& chunks) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < scene.instances.size(); ++k) {
        const std::size_t triangles = scene.instances[k].mesh->triangles.size();
        for (std::size_t first = 0; first < triangles; first += kChunkTriangles) {
            if (chunks.size() == count) chunks.emplace_back();
            Chunk& chunk = chunks[count++];  // keeps its memory from frame to frame
            chunk.instance = static_cast<int>(k);
            chunk.first = static_cast<std::uint32_t>(first);
            chunk.count = static_cast<std::uint32_t>(
                std::min<std::size_t>(kChunkTriangles, triangles - first));
        }
    }
    chunks.resize(count);
}

}  // namespace

void prepare(const SceneView& scene, const FrameContext& frame, PixelRect window,
             const parallel::Arena& arena, Geometry& geometry) {
    PENUMBRA_ASSERT(frame.width <= kGuardBand && frame.height <= kGuardBand, "{} x {} pixels",
                    frame.width, frame.height);
    geometry.tile_window = whole_tiles(window);
    geometry.bins.grid = {geometry.tile_window.width() / kTileSize,
                          geometry.tile_window.height() / kTileSize};
    make_tables(scene, geometry.tables);
    project_all(scene, frame.isa, arena, geometry);

    make_chunks(scene, geometry.chunks);
    geometry.of_workers.resize(static_cast<std::size_t>(arena.threads()));
    for (ChunkScratch& scratch : geometry.of_workers)
        scratch.binning.reset(geometry.bins.grid.bin_count());
    arena.for_each(static_cast<int>(geometry.chunks.size()), [&](int chunk, int worker) {
        sort_chunk(scene, frame.isa, geometry, geometry.of_workers[worker], geometry.chunks[chunk]);
    });
    collect(geometry.chunks, geometry.bins.grid, geometry.bins);
}

std::size_t allocated_bytes(const Geometry& geometry) {
    const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    std::size_t total = bytes(geometry.tables.instances) + bytes(geometry.tables.materials) +
                        bytes(geometry.tables.cutouts) + bytes(geometry.vertices) +
                        bytes(geometry.chunks) + bytes(geometry.bins.parts) +
                        bytes(geometry.bins.first);
    for (const Chunk& chunk : geometry.chunks)
        total += bytes(chunk.references) + bytes(chunk.parts) + bytes(chunk.clipped);
    for (const ChunkScratch& scratch : geometry.of_workers)
        total +=
            scratch.binning.allocated_bytes() + bytes(scratch.candidates) + bytes(scratch.crossing);
    return total;
}

}  // namespace penumbra::raster
