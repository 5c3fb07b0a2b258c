#pragma once

#include "raster/snapped.h"

// Edge functions on the pixel grid. The function of the edge from a to b at a point p is the cross
// product (b - a) x (p - a), with y down; it is positive inside a triangle of positive area. A
// point on an edge belongs to the triangle if it is a left edge (it runs up) or a top edge (it runs
// level, to the right): the integer function is lowered by one for the others, so that inside is
// >= 0 for all.

namespace penumbra::raster {

// One edge at pixel centres. Those lie 256 units apart: floor(function / 256) steps by whole
// numbers and keeps its sign.
template <class I>
struct PixelEdge {
    I value;           // at a chosen pixel's centre
    I step_x, step_y;  // to the next pixel right, below
};

// In integers that hold the products: 64 bits for any snapped vertices, 32 for those that
// TriangleBatch lets through (kMaxBatchExtent).
template <class I>
PixelEdge<I> pixel_edge(I ax, I ay, I bx, I by, I center_x, I center_y) {
    const I dx = bx - ax;
    const I dy = by - ay;
    const auto owns_its_points = (dy < I(0)) | ((dy == I(0)) & (dx > I(0)));
    const I bias = simd::select(owns_its_points, I(0), I(-1));
    const I function = dx * (center_y - ay) - dy * (center_x - ax) + bias;
    return {function >> kSubpixelBits, I(0) - dy, dx};
}

// Twice the area of a triangle: positive where its vertices run clockwise on the screen.
template <class I>
I doubled_area(I ax, I ay, I bx, I by, I cx, I cy) {
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
}

// The centre of a pixel on the grid.
inline constexpr std::int32_t pixel_center(int pixel) {
    return pixel * kSubpixels + kSubpixels / 2;
}

// The first pixel whose centre is at or after a coordinate, and the last at or before.
template <class I>
I first_pixel(I coordinate) {
    return (coordinate + I(kSubpixels / 2 - 1)) >> kSubpixelBits;
}
template <class I>
I last_pixel(I coordinate) {
    return (coordinate - I(kSubpixels / 2)) >> kSubpixelBits;
}

}  // namespace penumbra::raster
