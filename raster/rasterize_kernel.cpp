#include "raster/rasterize_kernel.h"

#include "core/simd/kernel.h"
#include "raster/triangle_batch.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

using namespace raster;

constexpr int kPartsPerCell = kCellPixels / kLanes;

// ---- what is done with covered pixels ----------------------------------------------------------

// `kLanes` pixels of a cell: their place in the tile's memory and the first one's position in the
// tile (of the cell's, not of the part's).
struct CellPart {
    int at;
    F x, y;  // of each lane
};

// Keeps the nearest triangle of each pixel.
class DepthTest {
  public:
    DepthTest(const TileJob& job, TileMemory& memory) : job_(job), memory_(memory) {}

    void begin_run(const TriangleRun& run) { run_ = &run; }
    void begin_triangle(const TileTriangle& triangle) {
        if (triangle.cutout) load_cutout(triangle);
    }
    // A pixel must be nearer than what it shows: a triangle that equals it at best never is.
    [[nodiscard]] bool hides(int group, const TileTriangle& triangle) const {
        return triangle.depth.high <= memory_.farthest[group];
    }
    void cover(const TileTriangle& triangle, const CellPart& part, M covered) {
        const DepthPlane<float>& plane = triangle.depth;
        const F depth = simd::clamp(
            simd::fma(part.x, F(plane.step_x), simd::fma(part.y, F(plane.step_y), F(plane.value))),
            F(plane.low), F(plane.high));
        const F previous = simd::load<F>(memory_.inverse_depth + part.at);
        M nearer = covered & (depth > previous);
        if (triangle.cutout && simd::any(nearer)) nearer &= is_opaque_at(triangle, part);
        if (simd::none(nearer)) return;
        simd::store(memory_.inverse_depth + part.at, simd::select(nearer, depth, previous));
        write(memory_.instance + part.at, nearer, run_->instance_index);
        write(memory_.triangle + part.at, nearer, triangle.index);
    }
    void end_cell(int group) {
        constexpr int kWritesBetween = 8;  // cells; speed only: the image is the same for any
        if (++memory_.writes[group] >= kWritesBetween) refresh(group);
    }

  private:
    static void write(std::uint32_t* to, M where, std::uint32_t value) {
        simd::store(to, simd::select(where, U(value), simd::load<U>(to)));
    }

    void load_cutout(const TileTriangle& triangle) {
        const InstanceTable& instance = *run_->instance;
        const std::int32_t* const vertices = instance.vertices + std::size_t{triangle.index} * 3;
        Vec3<F> p[3];
        for (int k = 0; k < 3; ++k) {
            const float* const position = instance.positions + std::size_t(vertices[k]) * 3;
            p[k] = {F(position[0]), F(position[1]), F(position[2])};
            uv_[k] = {F(0), F(0)};
            if (!instance.uvs) continue;
            const float* const uv = instance.uvs + std::size_t(vertices[k]) * 2;
            uv_[k] = {F(uv[0]), F(uv[1])};
        }
        relative_ = relative_triangle(broadcast<F>(job_.camera.eye), p[0], p[1], p[2]);
    }
    M is_opaque_at(const TileTriangle& triangle, const CellPart& part) const {
        const F x = part.x + F(static_cast<float>(job_.tile.x0) + 0.5f);
        const F y = part.y + F(static_cast<float>(job_.tile.y0) + 0.5f);
        return is_opaque(*triangle.cutout, relative_, uv_, job_.camera.direction(x, y));
    }

    void refresh(int group) {
        const int cell_x = group % kGroupsPerRow * 2;
        const int cell_y = group / kGroupsPerRow * 2;
        F least(1e30f);
        for (int k = 0; k < 4; ++k) {
            const int cell = (cell_y + k / 2) * kCellsPerRow + cell_x + k % 2;
            for (int part = 0; part < kPartsPerCell; ++part)
                least = simd::min(least, simd::load<F>(memory_.inverse_depth + cell * kCellPixels +
                                                       part * kLanes));
        }
        alignas(64) float lanes[kLanes];
        simd::store(lanes, least);
        float result = lanes[0];
        for (int k = 1; k < kLanes; ++k) result = simd::min(result, lanes[k]);
        memory_.farthest[group] = result;
        memory_.writes[group] = 0;
    }

    const TileJob& job_;
    TileMemory& memory_;
    const TriangleRun* run_ = nullptr;
    RelativeTriangle<F> relative_{};
    Vec2<F> uv_[3]{};
};

// Counts all triangles of each pixel.
class Counter {
  public:
    Counter(const TileJob&, TileMemory& memory) : memory_(memory) {}

    void begin_run(const TriangleRun&) {}
    void begin_triangle(const TileTriangle&) {}
    [[nodiscard]] bool hides(int, const TileTriangle&) const { return false; }
    void cover(const TileTriangle& triangle, const CellPart& part, M covered) {
        std::int32_t* const counts = (triangle.is_front ? memory_.front : memory_.back) + part.at;
        simd::store(counts, simd::load<I>(counts) + simd::select(covered, I(1), I(0)));
    }
    void end_cell(int) {}

  private:
    TileMemory& memory_;
};

// ---- the loops over a triangle's pixels
// ----------------------------------------------------------

template <class Sink>
class TileLoop {
  public:
    TileLoop(const TileJob& job, TileMemory& memory) : job_(job), sink_(job, memory) {
        const I lane = simd::iota<I>();
        for (int part = 0; part < kPartsPerCell; ++part) {
            lane_x_[part] = lane & I(kCellSize - 1);
            lane_y_[part] = (lane + I(part * kLanes)) >> 2;
        }
    }

    void run() {
        for (int k = 0; k < job_.run_count; ++k) draw_run(job_.runs[k]);
    }

  private:
    void draw_run(const TriangleRun& run) {
        sink_.begin_run(run);
        next_clipped_ = 0;
        for (int first = 0; first < run.count; first += kLanes) {
            batch_.set_up(job_, run, first);
            const int count = run.count - first;
            const std::uint32_t exist = count >= kLanes ? ~0u : (1u << count) - 1;
            std::uint32_t rest = (batch_.touching() | batch_.oversized()) & exist;
            for (; rest != 0; rest &= rest - 1) draw_lane(run, __builtin_ctz(rest));
        }
    }

    void draw_lane(const TriangleRun& run, int lane) {
        TileTriangle triangle;
        triangle.cutout = nullptr;
        if (run.instance->cutouts) {
            const CutoutMap& map = run.instance->cutouts[run.instance->slots[batch_.index(lane)]];
            if (map.texels) triangle.cutout = &map;
        }
        if ((batch_.oversized() >> lane & 1) != 0) return draw_oversized(run, lane, triangle);
        batch_.extract(lane, triangle);
        draw(triangle);
    }

    void draw_oversized(const TriangleRun& run, int lane, TileTriangle& triangle) {
        triangle.index = batch_.index(lane);
        triangle.depth = batch_.depth(lane);
        const std::int32_t* const vertices =
            run.instance->vertices + std::size_t{triangle.index} * 3;
        SnappedVertex corners[kMaxClippedTriangleVertices];
        int count = 3;
        const SnappedVertex* polygon = corners;
        bool is_clipped = false;
        for (int k = 0; k < 3; ++k) {
            corners[k] = run.instance->snapped[vertices[k]];
            is_clipped |= corners[k].x <= kLargestUnsnappable;
        }
        if (is_clipped) {
            while (run.clipped[next_clipped_].triangle < triangle.index) ++next_clipped_;
            count = run.clipped[next_clipped_].vertex_count;
            polygon = run.clipped[next_clipped_].vertices;
        }
        for (int k = 1; k + 1 < count; ++k)
            if (set_up_edges(polygon[0], polygon[k], polygon[k + 1], job_.tile, triangle))
                draw(triangle);
    }

    void draw(const TileTriangle& triangle) {
        for (int part = 0; part < kPartsPerCell; ++part)
            for (int k = 0; k < 3; ++k)
                lane_edges_[part][k] = lane_x_[part] * I(triangle.edges[k].step_x) +
                                       lane_y_[part] * I(triangle.edges[k].step_y);
        sink_.begin_triangle(triangle);
        const PixelBounds& b = triangle.bounds;
        for (int y = b.y0 / kGroupSize; y <= b.y1 / kGroupSize; ++y)
            for (int x = b.x0 / kGroupSize; x <= b.x1 / kGroupSize; ++x) draw_group(triangle, x, y);
    }

    void draw_group(const TileTriangle& triangle, int group_x, int group_y) {
        const int group = group_y * kGroupsPerRow + group_x;
        if (sink_.hides(group, triangle)) return;
        const PixelBounds& b = triangle.bounds;
        const int x0 = simd::max(group_x * 2, b.x0 / kCellSize);
        const int y0 = simd::max(group_y * 2, b.y0 / kCellSize);
        const int x1 = simd::min(group_x * 2 + 1, b.x1 / kCellSize);
        const int y1 = simd::min(group_y * 2 + 1, b.y1 / kCellSize);
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) draw_cell(triangle, group, x, y);
    }

    void draw_cell(const TileTriangle& triangle, int group, int cell_x, int cell_y) {
        const auto x = static_cast<std::uint32_t>(cell_x * kCellSize);
        const auto y = static_cast<std::uint32_t>(cell_y * kCellSize);
        I base[3];
        for (int k = 0; k < 3; ++k) base[k] = I(value_at(triangle.edges[k], x, y));
        bool covers = false;
        for (int part = 0; part < kPartsPerCell; ++part) {
            const I outside = (base[0] + lane_edges_[part][0]) | (base[1] + lane_edges_[part][1]) |
                              (base[2] + lane_edges_[part][2]);
            const M covered = outside >= I(0);
            if (simd::none(covered)) continue;
            covers = true;
            const int at = (cell_y * kCellsPerRow + cell_x) * kCellPixels + part * kLanes;
            sink_.cover(triangle,
                        {at, simd::to_float(lane_x_[part] + I(cell_x * kCellSize)),
                         simd::to_float(lane_y_[part] + I(cell_y * kCellSize))},
                        covered);
        }
        if (covers) sink_.end_cell(group);
    }

    // Sums wrap on the way, but the result fits: see set_up_edges.
    static std::int32_t value_at(const PixelEdge<std::int32_t>& edge, std::uint32_t x,
                                 std::uint32_t y) {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(edge.value) +
                                         static_cast<std::uint32_t>(edge.step_x) * x +
                                         static_cast<std::uint32_t>(edge.step_y) * y);
    }

    const TileJob& job_;
    Sink sink_;
    TriangleBatch<F> batch_;
    I lane_x_[kPartsPerCell], lane_y_[kPartsPerCell];
    I lane_edges_[kPartsPerCell]
                 [3];  // what each lane adds to an edge's value at the cell's first pixel
    int next_clipped_ = 0;
};

void fill(std::uint32_t* to, int count, std::uint32_t value) {
    for (int k = 0; k < count; k += kLanes) simd::store(to + k, U(value));
}
void fill(float* to, int count, float value) {
    for (int k = 0; k < count; k += kLanes) simd::store(to + k, F(value));
}
void fill(std::int32_t* to, int count, std::int32_t value) {
    for (int k = 0; k < count; k += kLanes) simd::store(to + k, I(value));
}

}  // namespace

void rasterize_tile(const TileJob& job, TileMemory& memory) {
    constexpr int kGroups = kGroupsPerRow * kGroupsPerRow;
    fill(memory.inverse_depth, kTilePixels, 0.0f);
    fill(memory.instance, kTilePixels, 0xFFFFFFFFu);
    fill(memory.triangle, kTilePixels, 0xFFFFFFFFu);
    fill(memory.farthest, kGroups, 0.0f);
    fill(memory.writes, kGroups, 0);
    TileLoop<DepthTest>(job, memory).run();
}

void count_tile_coverage(const TileJob& job, TileMemory& memory) {
    fill(memory.front, kTilePixels, 0);
    fill(memory.back, kTilePixels, 0);
    TileLoop<Counter>(job, memory).run();
}

}  // namespace penumbra::PENUMBRA_ISA
