#include "raster/classify_kernel.h"

#include "core/simd/kernel.h"
#include "raster/edges.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

using namespace raster;

struct Corners {
    I x[3], y[3];
};

Corners load_corners(const InstanceTable& instance, I triangle) {
    const auto* const snapped = reinterpret_cast<const std::int32_t*>(instance.snapped);
    Corners corners;
    for (int k = 0; k < 3; ++k) {
        const I vertex = simd::gather(instance.vertices + k, triangle * I(3));
        corners.x[k] = simd::gather(snapped, vertex * I(2));
        corners.y[k] = simd::gather(snapped + 1, vertex * I(2));
    }
    return corners;
}

struct Bounds {
    I x0, y0, x1, y1;  // pixels whose centres lie in it, inclusive
};

Bounds pixel_bounds(const Corners& c) {
    return {first_pixel(simd::min(simd::min(c.x[0], c.x[1]), c.x[2])),
            first_pixel(simd::min(simd::min(c.y[0], c.y[1]), c.y[2])),
            last_pixel(simd::max(simd::max(c.x[0], c.x[1]), c.x[2])),
            last_pixel(simd::max(simd::max(c.y[0], c.y[1]), c.y[2]))};
}

// Exact for triangles whose bounds hold at most 2 x 2 pixel centres; meaningless for others.
M covers_one_of_four(const Corners& c, const Bounds& bounds) {
    const M swapped = doubled_area(c.x[0], c.y[0], c.x[1], c.y[1], c.x[2], c.y[2]) < I(0);
    const I x[3] = {c.x[0], simd::select(swapped, c.x[2], c.x[1]),
                    simd::select(swapped, c.x[1], c.x[2])};
    const I y[3] = {c.y[0], simd::select(swapped, c.y[2], c.y[1]),
                    simd::select(swapped, c.y[1], c.y[2])};
    const I center_x = (bounds.x0 << kSubpixelBits) + I(kSubpixels / 2);
    const I center_y = (bounds.y0 << kSubpixelBits) + I(kSubpixels / 2);
    I sign[4] = {I(0), I(0), I(0), I(0)};  // negative where outside of an edge
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const PixelEdge<I> edge = pixel_edge(x[k], y[k], x[next], y[next], center_x, center_y);
        sign[0] |= edge.value;
        sign[1] |= edge.value + edge.step_x;
        sign[2] |= edge.value + edge.step_y;
        sign[3] |= edge.value + edge.step_x + edge.step_y;
    }
    return (sign[0] >= I(0)) | (sign[1] >= I(0)) | (sign[2] >= I(0)) | (sign[3] >= I(0));
}

// Which triangles may cover a centre of the window, and the window's part of their bounds.
M may_cover(const Corners& corners, const PixelRect& window, Bounds& bounds) {
    const Bounds all = pixel_bounds(corners);
    bounds = {simd::max(all.x0, I(window.x0)), simd::max(all.y0, I(window.y0)),
              simd::min(all.x1, I(window.x1 - 1)), simd::min(all.y1, I(window.y1 - 1))};
    const M overlaps = (bounds.x0 <= bounds.x1) & (bounds.y0 <= bounds.y1);
    const M is_tiny = (all.x1 - all.x0 < I(2)) & (all.y1 - all.y0 < I(2));
    return overlaps & ((!is_tiny) | covers_one_of_four(corners, all));
}

// Appends the triangles of a mask.
void append(const ClassifyJob& job, std::int32_t first, M kept, const Bounds& b,
            std::int32_t& count) {
    constexpr int kTileBits = 6;
    static_assert(1 << kTileBits == kTileSize);
    alignas(64) std::int32_t tiles[4][kLanes];
    simd::store(tiles[0], (b.x0 - I(job.tile_window.x0)) >> kTileBits);
    simd::store(tiles[1], (b.y0 - I(job.tile_window.y0)) >> kTileBits);
    simd::store(tiles[2], (b.x1 - I(job.tile_window.x0)) >> kTileBits);
    simd::store(tiles[3], (b.y1 - I(job.tile_window.y0)) >> kTileBits);
    for (std::uint32_t rest = simd::bits(kept); rest != 0; rest &= rest - 1) {
        const int k = __builtin_ctz(rest);
        job.candidates[count++] = {
            job.first + static_cast<std::uint32_t>(first + k),
            static_cast<std::uint16_t>(tiles[0][k]), static_cast<std::uint16_t>(tiles[1][k]),
            static_cast<std::uint16_t>(tiles[2][k]), static_cast<std::uint16_t>(tiles[3][k])};
    }
}

}  // namespace

ClassifyCounts classify_triangles(const ClassifyJob& job) {
    ClassifyCounts counts;
    for (std::int32_t first = 0; first < job.count; first += kLanes) {
        const I index = I(first) + simd::iota<I>();
        const M exists = index < I(job.count);
        const I triangle =
            I(static_cast<std::int32_t>(job.first)) + simd::min(index, I(job.count - 1));
        const Corners corners = load_corners(*job.instance, triangle);
        const I lowest = simd::min(simd::min(corners.x[0], corners.x[1]), corners.x[2]);
        const M crosses = exists & (lowest <= I(kLargestUnsnappable));

        Bounds bounds;
        const M kept = exists & !crosses & may_cover(corners, job.tile_window, bounds);
        if (simd::any(kept)) append(job, first, kept, bounds, counts.candidates);
        if (simd::none(crosses)) continue;

        // Outside one plane with all vertices: gone. A snapped vertex is outside of none.
        const auto outcode = [](I x) {
            return simd::select(x <= I(kLargestUnsnappable), x & I(255), I(0));
        };
        const M clipped =
            crosses &
            ((outcode(corners.x[0]) & outcode(corners.x[1]) & outcode(corners.x[2])) == I(0));
        for (std::uint32_t rest = simd::bits(clipped); rest != 0; rest &= rest - 1)
            job.crossing[counts.crossing++] =
                job.first + static_cast<std::uint32_t>(first + __builtin_ctz(rest));
    }
    return counts;
}

}  // namespace penumbra::PENUMBRA_ISA
