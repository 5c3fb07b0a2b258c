#include "apps/diff/tile_metrics.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "apps/diff/colour_region.h"
#include "core/compare/ssim.h"
#include "core/image/half.h"

namespace penumbra::diff {
namespace {

struct Value {
    double reference, test;
    [[nodiscard]] bool is_finite() const { return std::isfinite(reference) && std::isfinite(test); }
};

Value value_at(const TileContext& context, int slot, int x, int y) {
    const PartReader& reader = context.reader;
    if (reader.slot(slot).holds_ids)
        return {static_cast<double>(reader.ids(Side::kReference, slot, y)[x]),
                static_cast<double>(reader.ids(Side::kTest, slot, y)[x])};
    return {static_cast<double>(reader.floats(Side::kReference, slot, y)[x]),
            static_cast<double>(reader.floats(Side::kTest, slot, y)[x])};
}

void count_non_finite(double value, NonFinite& counts) {
    if (std::isnan(value)) ++counts.nan;
    if (std::isinf(value)) ++counts.infinite;
}

// Equal rows need no look at their pixels.
bool add_equal_row(const TileContext& context, const TileRect& tile, int y, TileSums& sums) {
    if (context.mask != nullptr) return false;
    const auto width = static_cast<std::size_t>(tile.width());
    for (const int slot : context.layer.slots) {
        if (!context.reader.is_same(slot, y, tile.x0, tile.x1)) return false;
        if (context.reader.slot(slot).holds_ids) continue;
        const float* row = context.reader.floats(Side::kReference, slot, y) + tile.x0;
        if (image::count_non_finite({row, width}) > 0) return false;
    }
    sums.pixels += width;
    sums.errors.values += width * context.layer.slots.size();
    for (int x = tile.x0; x < tile.x1; x += kBlockSize)
        sums.block_errors[(x - tile.x0) / kBlockSize].count +=
            static_cast<std::uint64_t>(std::min(kBlockSize, tile.x1 - x));
    return true;
}

bool add_if_not_finite(const TileContext& context, int x, int y, TileSums& sums) {
    bool finite = true;
    for (const int slot : context.layer.slots) {
        const Value value = value_at(context, slot, x, y);
        if (value.is_finite()) continue;
        finite = false;
        count_non_finite(value.reference, sums.reference);
        count_non_finite(value.test, sums.test);
    }
    return !finite;
}

void add_pixel(const TileContext& context, const TileRect& tile, int x, int y, TileSums& sums) {
    ++sums.pixels;
    MeanSum& block = sums.block_errors[(x - tile.x0) / kBlockSize];
    if (add_if_not_finite(context, x, y, sums)) {
        ++sums.exceeding;
        block.add(1);
        return;
    }
    double largest = 0, relative = 0;
    bool differs = false;
    for (std::size_t i = 0; i < context.layer.slots.size(); ++i) {
        const int slot = context.layer.slots[i];
        const Value value = value_at(context, slot, x, y);
        sums.errors.add(value.reference, value.test);
        if (!values_differ(context, slot, x, y)) continue;
        ++sums.differing[i];
        differs = true;
        largest = std::max(largest, std::abs(value.test - value.reference));
        relative = std::max(relative, relative_difference(context, slot, x, y));
    }
    // A difference of denormal numbers is 0 with denormals flushed, but it is one.
    if (context.pixel_threshold > 0 ? largest > context.pixel_threshold : differs) ++sums.exceeding;
    block.add(relative);
}

// Mean over the region's pixels that count.
template <class Use>
void for_each_counted(const TileContext& context, const TileRect& tile, const Use& use) {
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
            if (context.counts(x, y)) use(x, y);
}

bool is_ssim_centre(const TileContext& context, int x, int y) {
    return compare::is_whole_window(x, context.reader.width()) &&
           compare::is_whole_window(y, context.reader.height());
}

// What the measures below give where both images are the same: 1, 0 and 0.
void add_same_colours(const TileContext& context, const TileRect& tile, TileSums& sums) {
    for_each_counted(context, tile, [&](int x, int y) {
        sums.coded.values += 3;
        if (is_ssim_centre(context, x, y)) sums.ssim.add(MeanSum{3.0, 3});
        ++sums.flip.count;
        ++sums.hdr_flip.count;
    });
}

void measure_coded(const TileContext& context, const TileRect& tile, const ColourRegion& region,
                   TileSums& sums) {
    const Plane3<float> a = to_coded(region.reference, context, region.extent);
    const Plane3<float> b = to_coded(region.test, context, region.extent);
    Plane<float> similarity(tile.width(), tile.height());
    for (std::size_t channel = 0; channel < 3; ++channel) {
        compare::ssim_map(a[channel], b[channel], region.extent, similarity);
        for_each_counted(context, tile, [&](int x, int y) {
            const int column = x - tile.x0, row = y - tile.y0, halo = region.extent.halo;
            sums.coded.add(static_cast<double>(a[channel].at(column + halo, row + halo)),
                           static_cast<double>(b[channel].at(column + halo, row + halo)));
            if (is_ssim_centre(context, x, y))
                sums.ssim.add(static_cast<double>(similarity.at(column, row)));
        });
    }
}

void measure_flip(const TileContext& context, const TileRect& tile, const ColourRegion& region,
                  TileSums& sums) {
    Plane<float> errors(tile.width(), tile.height());
    compare::flip_map(to_linear(region.reference, context, region.extent),
                      to_linear(region.test, context, region.extent), region.extent, errors);
    for_each_counted(context, tile, [&](int x, int y) {
        const double error = static_cast<double>(errors.at(x - tile.x0, y - tile.y0));
        sums.flip.add(error);
        sums.block_errors[(x - tile.x0) / kBlockSize].sum += error;
    });
}

void measure_hdr_flip(const TileContext& context, const TileRect& tile, const ColourRegion& region,
                      TileSums& sums) {
    Plane<float> errors(tile.width(), tile.height());
    compare::hdr_flip_map(region.reference, region.test, context.exposures, region.extent, errors);
    for_each_counted(context, tile, [&](int x, int y) {
        sums.hdr_flip.add(static_cast<double>(errors.at(x - tile.x0, y - tile.y0)));
    });
}

void measure_colours(const TileContext& context, const TileRect& tile, TileSums& sums) {
    // Blocks of colours are ranked by FLIP; what no display shows still tells them apart.
    constexpr double kUnseenShare = 1e-3;
    if (context.metrics.has(Metric::kFlip))
        for (MeanSum& block : sums.block_errors) block.sum *= kUnseenShare;
    if (has_same_colours(context, tile)) return add_same_colours(context, tile, sums);
    const ColourRegion region = gather_colours(context, tile);
    if (context.metrics.has(Metric::kPsnr) || context.metrics.has(Metric::kSsim))
        measure_coded(context, tile, region, sums);
    if (context.metrics.has(Metric::kFlip)) measure_flip(context, tile, region, sums);
    if (context.metrics.has(Metric::kHdrFlip)) measure_hdr_flip(context, tile, region, sums);
}

}  // namespace

void TileSums::add(const TileSums& other) {
    pixels += other.pixels;
    exceeding += other.exceeding;
    differing.resize(std::max(differing.size(), other.differing.size()));
    for (std::size_t i = 0; i < other.differing.size(); ++i) differing[i] += other.differing[i];
    for (auto [to, from] : {std::pair{&reference, &other.reference}, {&test, &other.test}}) {
        to->nan += from->nan;
        to->infinite += from->infinite;
    }
    errors.add(other.errors);
    coded.add(other.coded);
    ssim.add(other.ssim);
    flip.add(other.flip);
    hdr_flip.add(other.hdr_flip);
}

bool values_differ(const TileContext& context, int slot, int x, int y) {
    if (context.reader.is_same(slot, y, x, x + 1)) return false;
    if (context.reader.slot(slot).holds_ids) return true;
    // -0 and +0 differ in their sign bits alone.
    constexpr std::uint32_t kMagnitude = 0x7FFFFFFF;
    const auto bits = [&](Side side) {
        return std::bit_cast<std::uint32_t>(context.reader.floats(side, slot, y)[x]) & kMagnitude;
    };
    return (bits(Side::kReference) | bits(Side::kTest)) != 0;
}

double relative_difference(const TileContext& context, int slot, int x, int y) {
    if (!values_differ(context, slot, x, y)) return 0;
    const Value value = value_at(context, slot, x, y);
    if (context.reader.slot(slot).holds_ids || !value.is_finite()) return 1;
    const double largest = std::max(std::abs(value.reference), std::abs(value.test));
    return largest > 0 ? std::min(std::abs(value.test - value.reference) / largest, 1.0) : 0;
}

TileSums measure_tile(const TileContext& context, const TileRect& tile) {
    TileSums sums;
    sums.differing.resize(context.layer.slots.size());
    for (int y = tile.y0; y < tile.y1; ++y) {
        if (add_equal_row(context, tile, y, sums)) continue;
        for (int x = tile.x0; x < tile.x1; ++x)
            if (context.counts(x, y)) add_pixel(context, tile, x, y, sums);
    }
    if (!context.layer.colour.empty()) measure_colours(context, tile, sums);
    return sums;
}

}  // namespace penumbra::diff
