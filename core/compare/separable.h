#pragma once

#include <vector>

#include "core/image/plane.h"

// Filters that are products of one filter along rows and one along columns.

namespace penumbra::compare {

// An odd number of weights around the centre.
struct Filter {
    std::vector<float> weights;
    [[nodiscard]] int radius() const { return static_cast<int>(weights.size()) / 2; }
};

// exp(-x^2 / (2 sigma^2)) for |x| <= radius, divided by its sum.
[[nodiscard]] Filter gaussian(double sigma, int radius);

// A region with a margin: its planes hold `halo` pixels on every side of width x height. Rows and
// columns outside the picture repeat its edge.
struct Extent {
    int width = 0, height = 0;
    int halo = 0;
    [[nodiscard]] int padded_width() const { return width + 2 * halo; }
    [[nodiscard]] int padded_height() const { return height + 2 * halo; }
};

// A plane for a region and its halo, wide enough for vectors that read past the halo's end.
[[nodiscard]] Plane<float> make_region(const Extent& extent);

// Filters along the rows: all rows of the halo, columns of the region. Both planes begin at the
// halo's top row, `from` also at its left column, `to` at the region's.
void filter_rows(const Plane<float>& from, const Filter& filter, const Extent& extent,
                 Plane<float>& to);

// Filters what filter_rows() left along the columns; `to` holds the region alone.
void filter_columns(const Plane<float>& from, const Filter& filter, const Extent& extent,
                    Plane<float>& to);

}  // namespace penumbra::compare
