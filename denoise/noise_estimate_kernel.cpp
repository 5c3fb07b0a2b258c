#include "denoise/noise_estimate_kernel.h"

#include <limits>

#include "core/image/plane_lanes.h"
#include "core/simd/kernel.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

using denoise::kApronX;
using denoise::kApronY;
using denoise::kBlock;
using denoise::kCellColumns;
using denoise::kNoiseStride;
using denoise::NoiseChunk;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

// Scratch coordinates of an element of the planes.
int scratch_index(const NoiseChunk& c, int x, int y) {
    return (y - c.chunk.y0 + kApronY) * kNoiseStride + (x - c.chunk.x0 + kApronX);
}

M exists(const NoiseChunk& c, int x) {
    const I column = I(x) + simd::iota<I>();
    return (column >= I(c.existing.x0)) & (column < I(c.existing.x1));
}

// W_N of a row of the chunk and its apron, and the ranges of its cells.
void write_ratios(const NoiseChunk& c, int y) {
    const bool row_exists = y >= c.existing.y0 && y < c.existing.y1;
    float* const ratio = c.ratio + scratch_index(c, c.chunk.x0 - kApronX, y);
    const int cell = (y - c.chunk.y0 + kApronY) / kBlock * kCellColumns;
    const int width = c.chunk.width() + 2 * kApronX;
    for (int i = 0; i < width; i += kLanes) {
        const int x = c.chunk.x0 - kApronX + i;
        F w = F(kNaN);
        if (row_exists && x + kLanes > c.existing.x0 && x < c.existing.x1) {
            w = denoise::luminance_ratio(load3<F>(c.pass->term.shadowed, x, y),
                                         load3<F>(c.light, x, y));
            w = simd::select(exists(c, x), w, F(kNaN));
        }
        simd::store(ratio + i, w);
        float* const lowest = c.lowest + cell * kBlock + i;
        float* const highest = c.highest + cell * kBlock + i;
        // The second operand, where W is unknown, leaves the range as it is; knowledge gaps widen
        // it.
        simd::store(lowest, simd::min(w, simd::load<F>(lowest)));
        simd::store(highest, simd::max(w, simd::load<F>(highest)));
    }
}

// The range of each cell, from those of its columns to its first number. Minima and maxima are
// exact in any order.
void reduce_cells(const NoiseChunk& c, int cells) {
    for (int cell = 0; cell < cells; ++cell) {
        float* const lowest = c.lowest + cell * kBlock;
        float* const highest = c.highest + cell * kBlock;
        for (int i = 1; i < kBlock; ++i) {
            lowest[0] = simd::min(lowest[i], lowest[0]);
            highest[0] = simd::max(highest[i], highest[0]);
        }
    }
}

// Is W_N the same in a cell and the eight around it, as far as it is known?
bool is_constant_around(const NoiseChunk& c, int cell_column, int cell_row, int cell_rows) {
    float lowest = kInfinity;
    float highest = -kInfinity;
    for (int row = cell_row - 1; row <= cell_row + 1; ++row) {
        if (row < 0 || row >= cell_rows) continue;
        for (int column = cell_column - 1; column <= cell_column + 1; ++column) {
            const int cell = row * kCellColumns + column;
            lowest = simd::min(lowest, c.lowest[cell * kBlock]);
            highest = simd::max(highest, c.highest[cell * kBlock]);
        }
    }
    return lowest >= highest;
}

// E before the box of a block of pixels that exist at least in part.
void write_star_noise(const NoiseChunk& c, int x, int y) {
    const int index = scratch_index(c, x, y);
    const int rotation =
        denoise::line_rotation(x + c.pass->frame.window.x0, y + c.pass->frame.window.y0);
    for (int lane = 0; lane < kBlock; lane += kLanes) {
        const F noise =
            denoise::star_noise<F>(c.ratio + index + lane, c.rotations[rotation], c.pass->settings);
        simd::store(c.unsmoothed + index + lane, simd::select(exists(c, x + lane), noise, F(0)));
    }
}

// E before the box, of a row of blocks of the chunk and one block to both sides.
void write_unsmoothed_row(const NoiseChunk& c, int y, const bool* is_constant) {
    const bool row_exists = y >= c.existing.y0 && y < c.existing.y1;
    const int columns = (c.chunk.width() + 2 * kBlock) / kBlock;
    for (int column = 0; column < columns; ++column) {
        const int x = c.chunk.x0 - kBlock + column * kBlock;
        const bool is_inside = row_exists && x + kBlock > c.existing.x0 && x < c.existing.x1;
        if (is_inside && !is_constant[column]) {
            write_star_noise(c, x, y);
            continue;
        }
        for (int lane = 0; lane < kBlock; lane += kLanes)
            simd::store(c.unsmoothed + scratch_index(c, x + lane, y), F(0));
    }
}

F row_sum(const float* centre) {
    return (simd::load<F>(centre - 1) + simd::load<F>(centre + 1)) + simd::load<F>(centre);
}

// The mean over the pixels of the 3x3 box that exist.
F smoothed(const NoiseChunk& c, int x, int y) {
    const float* const centre = c.unsmoothed + scratch_index(c, x, y);
    const F sum =
        (row_sum(centre - kNoiseStride) + row_sum(centre + kNoiseStride)) + row_sum(centre);
    const I column = I(x) + simd::iota<I>();
    const F one = F(1);
    const F columns = one + simd::select(column > I(c.existing.x0), one, F(0)) +
                      simd::select(column < I(c.existing.x1 - 1), one, F(0));
    const int rows = 1 + (y > c.existing.y0) + (y < c.existing.y1 - 1);
    return sum / (columns * F(static_cast<float>(rows)));
}

void write_noise_row(const NoiseChunk& c, int y) {
    float* const noise = c.pass->noise.row(y);
    for (int x = c.chunk.x0; x < c.chunk.x1; x += kLanes) {
        F e = smoothed(c, x, y);
        const F ratio = simd::load<F>(c.ratio + scratch_index(c, x, y));
        const M unknown = ratio != ratio;
        if (simd::any(unknown)) {
            const M to_fill = unknown & (luminance(load3<F>(c.pass->term.unshadowed, x, y)) > F(0));
            e = simd::select(to_fill, F(1), e);
        }
        simd::store(noise + x, e);
    }
}

}  // namespace

void estimate_noise(const NoiseChunk& c) {
    const int reach = c.pass->settings.radius + 1;
    const int cell_rows = (c.chunk.height() + 2 * kApronY + kBlock - 1) / kBlock;
    for (int i = 0; i < cell_rows * kCellColumns * kBlock; ++i) {
        c.lowest[i] = kInfinity;
        c.highest[i] = -kInfinity;
    }
    for (int y = c.chunk.y0 - reach; y < c.chunk.y1 + reach; ++y) write_ratios(c, y);
    reduce_cells(c, cell_rows * kCellColumns);
    for (int cell_row = 0; cell_row < cell_rows; ++cell_row) {
        bool is_constant[kCellColumns];
        for (int column = 1; column + 1 < kCellColumns; ++column)
            is_constant[column - 1] = is_constant_around(c, column, cell_row, cell_rows);
        const int begin = c.chunk.y0 - kApronY + cell_row * kBlock;
        for (int y = begin; y < begin + kBlock; ++y)
            if (y >= c.chunk.y0 - 1 && y <= c.chunk.y1) write_unsmoothed_row(c, y, is_constant);
    }
    for (int y = c.chunk.y0; y < c.chunk.y1; ++y) write_noise_row(c, y);
}

}  // namespace penumbra::PENUMBRA_ISA
