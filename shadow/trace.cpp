#include "shadow/trace.h"

#include <xmmintrin.h>

#include <array>

#include "shadow/z_order.h"

namespace penumbra::shadow {
namespace {

constexpr unsigned kFullRow = (1u << kSquare) - 1;
constexpr unsigned kFullSquare = (1u << (kSquare * kSquare)) - 1;

// The active pixels of one row of a square.
unsigned row_bits(const std::array<std::uint64_t, kTileSize>& rows, SquarePlace place, int row) {
    return static_cast<unsigned>(rows[place.y + row] >> place.x) & kFullRow;
}

constexpr int kArrays = 7;
struct Copies {
    const float* from[kArrays];
    float* to[kArrays];
};

Copies copies(RayScratch& scratch) {
    auto& packed = scratch.packed;
    return {{scratch.origin[0].row(0), scratch.origin[1].row(0), scratch.origin[2].row(0),
             scratch.direction[0].row(0), scratch.direction[1].row(0), scratch.direction[2].row(0),
             scratch.range.row(0)},
            {packed.origin_x.row(0), packed.origin_y.row(0), packed.origin_z.row(0),
             packed.direction_x.row(0), packed.direction_y.row(0), packed.direction_z.row(0),
             packed.far_limit.row(0)}};
}

// Appends the active rays of four neighbouring pixels; returns the new count.
int append_row(const Copies& arrays, int pixel, unsigned active, int count) {
    if (active == kFullRow) {
        for (int i = 0; i < kArrays; ++i)
            _mm_storeu_ps(arrays.to[i] + count, _mm_loadu_ps(arrays.from[i] + pixel));
        return count + kSquare;
    }
    for (int column = 0; column < kSquare; ++column) {
        if (!((active >> column) & 1u)) continue;
        for (int i = 0; i < kArrays; ++i) arrays.to[i][count] = arrays.from[i][pixel + column];
        ++count;
    }
    return count;
}

// The active pixels of a square, row by row.
unsigned square_bits(const std::array<std::uint64_t, kTileSize>& rows, SquarePlace place) {
    return row_bits(rows, place, 0) | row_bits(rows, place, 1) << kSquare |
           row_bits(rows, place, 2) << (2 * kSquare) | row_bits(rows, place, 3) << (3 * kSquare);
}

void append_square(const Copies& arrays, int pixel, int count) {
    for (int i = 0; i < kArrays; ++i)
        for (int row = 0; row < kSquare; ++row)
            _mm_storeu_ps(arrays.to[i] + count + row * kSquare,
                          _mm_loadu_ps(arrays.from[i] + pixel + row * kTileSize));
}

int pack(RayScratch& scratch) {
    const Copies arrays = copies(scratch);
    int count = 0;
    for (const SquarePlace place : kSquaresInZOrder) {
        const int pixel = place.y * kTileSize + place.x;
        const unsigned active = square_bits(scratch.active, place);
        if (active == kFullSquare) {
            append_square(arrays, pixel, count);
            count += kSquare * kSquare;
            continue;
        }
        for (int row = 0; row < kSquare && active != 0; ++row)
            count = append_row(arrays, pixel + row * kTileSize,
                               (active >> (row * kSquare)) & kFullRow, count);
    }
    return count;
}

// The rays that are not blocked, of the next `active` ones from `count` on; moves `count` past
// them.
unsigned unpack_row(const float* far_limit, unsigned active, int& count) {
    if (active == kFullRow) {
        const int blocked = _mm_movemask_ps(_mm_loadu_ps(far_limit + count));
        count += kSquare;
        return ~static_cast<unsigned>(blocked) & kFullRow;
    }
    unsigned visible = 0;
    for (int column = 0; column < kSquare; ++column) {
        if (!((active >> column) & 1u)) continue;
        if (far_limit[count++] >= 0) visible |= 1u << column;
    }
    return visible;
}

void unpack(RayScratch& scratch) {
    const float* const far_limit = scratch.packed.far_limit.row(0);
    scratch.visible.fill(0);
    int count = 0;
    for (const SquarePlace place : kSquaresInZOrder)
        for (int row = 0; row < kSquare; ++row) {
            const unsigned active = row_bits(scratch.active, place, row);
            const std::uint64_t visible = unpack_row(far_limit, active, count);
            scratch.visible[place.y + row] |= visible << place.x;
        }
}

RayStream stream(RayScratch& scratch, int count) {
    auto& packed = scratch.packed;
    return {{packed.origin_x.row(0), packed.origin_y.row(0), packed.origin_z.row(0)},
            {packed.direction_x.row(0), packed.direction_y.row(0), packed.direction_z.row(0)},
            packed.near_limit.row(0),
            packed.far_limit.row(0),
            count};
}

}  // namespace

void trace(const Occluders& occluders, Visibility visibility, RayScratch& scratch) {
    if (visibility == Visibility::kForcedToOne) {
        scratch.visible = scratch.active;
        return;
    }
    const int count = pack(scratch);
    if (count > 0) occluders.occlude(stream(scratch, count));
    unpack(scratch);
}

}  // namespace penumbra::shadow
