#pragma once

#include "raster/tile_setup.h"

// Triangles of a run, set up for a tile as many at a time as there are lanes. For kernels only.

namespace penumbra::raster {

// A batch's edges are 32-bit products. With vertices at most this far apart, and a tile that the
// triangle's bounds touch, they stay below 2^31: both factors of a product are below 2^15 (64
// pixels are 2^14 units, and a pixel of the tile is at most 128 pixels from a vertex). Larger
// triangles are set up one by one in 64 bits.
inline constexpr std::int32_t kMaxBatchExtent = kTileSize * kSubpixels;

template <class F>
class TriangleBatch {
  public:
    using I = simd::IntOf<F>;
    using M = simd::MaskOf<F>;
    static constexpr int kLanes = simd::kLanes<F>;

    // The next triangles of a run, from reference `first` on.
    void set_up(const TileJob& job, const TriangleRun& run, int first) {
        const I position = simd::min(I(first) + simd::iota<I>(), I(run.count - 1));
        const I triangle =
            simd::gather(reinterpret_cast<const std::int32_t*>(run.references), position);
        simd::store(index_, triangle);
        I vertex[3];
        for (int k = 0; k < 3; ++k)
            vertex[k] = simd::gather(run.instance->vertices + k, triangle * I(3));
        set_up_edges_of(job.tile, *run.instance, vertex);
        set_up_depth_of(job, *run.instance, vertex);
    }

    // Bit per lane: cannot be set up here. Of the others: touches the tile.
    [[nodiscard]] std::uint32_t oversized() const { return oversized_; }
    [[nodiscard]] std::uint32_t touching() const { return touching_; }

    [[nodiscard]] std::uint32_t index(int lane) const {
        return static_cast<std::uint32_t>(index_[lane]);
    }
    [[nodiscard]] DepthPlane<float> depth(int lane) const {
        return {depth_[0][lane], depth_[1][lane], depth_[2][lane], depth_[3][lane],
                depth_[4][lane]};
    }
    void extract(int lane, TileTriangle& triangle) const {
        for (int k = 0; k < 3; ++k)
            triangle.edges[k] = {edges_[k][0][lane], edges_[k][1][lane], edges_[k][2][lane]};
        triangle.depth = depth(lane);
        triangle.bounds = {bounds_[0][lane], bounds_[1][lane], bounds_[2][lane], bounds_[3][lane]};
        triangle.index = index(lane);
        triangle.is_front = (front_ >> lane & 1) != 0;
    }

  private:
    void set_up_edges_of(const Tile& tile, const InstanceTable& instance, const I (&vertex)[3]) {
        const auto* const snapped = reinterpret_cast<const std::int32_t*>(instance.snapped);
        I x[3], y[3];
        for (int k = 0; k < 3; ++k) {
            x[k] = simd::gather(snapped, vertex[k] * I(2));
            y[k] = simd::gather(snapped + 1, vertex[k] * I(2));
        }
        const I low_x = simd::min(simd::min(x[0], x[1]), x[2]);
        const I low_y = simd::min(simd::min(y[0], y[1]), y[2]);
        const I high_x = simd::max(simd::max(x[0], x[1]), x[2]);
        const I high_y = simd::max(simd::max(y[0], y[1]), y[2]);
        const M small = (low_x > I(kLargestUnsnappable)) & (high_x - low_x <= I(kMaxBatchExtent)) &
                        (high_y - low_y <= I(kMaxBatchExtent));
        constexpr int kLast = kTileSize - 1;
        const I x0 = simd::max(first_pixel(low_x) - I(tile.x0), I(0));
        const I y0 = simd::max(first_pixel(low_y) - I(tile.y0), I(0));
        const I x1 = simd::min(last_pixel(high_x) - I(tile.x0), I(kLast));
        const I y1 = simd::min(last_pixel(high_y) - I(tile.y0), I(kLast));
        oversized_ = simd::bits(!small);
        touching_ = simd::bits(small & (x0 <= x1) & (y0 <= y1));
        simd::store(bounds_[0], x0);
        simd::store(bounds_[1], y0);
        simd::store(bounds_[2], x1);
        simd::store(bounds_[3], y1);

        const M is_front = doubled_area(x[0], y[0], x[1], y[1], x[2], y[2]) < I(0);
        front_ = simd::bits(is_front);
        swap(is_front, x[1], x[2]);
        swap(is_front, y[1], y[2]);
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3;
            const PixelEdge<I> edge = pixel_edge(
                x[k], y[k], x[next], y[next], I(pixel_center(tile.x0)), I(pixel_center(tile.y0)));
            simd::store(edges_[k][0], edge.value);
            simd::store(edges_[k][1], edge.step_x);
            simd::store(edges_[k][2], edge.step_y);
        }
    }

    void set_up_depth_of(const TileJob& job, const InstanceTable& instance, const I (&vertex)[3]) {
        Vec3<F> p[3];
        for (int k = 0; k < 3; ++k) {
            const I at = vertex[k] * I(3);
            p[k] = {simd::gather(instance.positions, at), simd::gather(instance.positions + 1, at),
                    simd::gather(instance.positions + 2, at)};
        }
        const DepthPlane<F> plane = depth_plane(job.camera, job.tile, p);
        simd::store(depth_[0], plane.value);
        simd::store(depth_[1], plane.step_x);
        simd::store(depth_[2], plane.step_y);
        simd::store(depth_[3], plane.low);
        simd::store(depth_[4], plane.high);
    }

    static void swap(M where, I& a, I& b) {
        const I swapped = simd::select(where, b, a);
        b = simd::select(where, a, b);
        a = swapped;
    }

    alignas(64) std::int32_t index_[kLanes];
    alignas(64) std::int32_t edges_[3][3][kLanes];  // edge; value, step_x, step_y
    alignas(64) std::int32_t bounds_[4][kLanes];
    alignas(64) float depth_[5][kLanes];
    std::uint32_t oversized_, touching_, front_;
};

}  // namespace penumbra::raster
