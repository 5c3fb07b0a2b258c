#include "apps/diff/colour_region.h"

#include <algorithm>
#include <cmath>

#include "core/compare/transfer.h"

namespace penumbra::diff {
namespace {

constexpr int kHalo = compare::kFlipHalo;

void gather_pixel(const TileContext& context, int x, int y, const float* const from[2],
                  float* const to[2]) {
    const float reference = from[0][x];
    const float test = from[1][x];
    const float shown = std::isfinite(reference) ? reference : 0;
    const bool usable = std::isfinite(reference) && std::isfinite(test) && context.counts(x, y);
    *to[0] = shown;
    *to[1] = usable ? test : shown;
}

}  // namespace

ColourRegion gather_colours(const TileContext& context, const TileRect& tile) {
    ColourRegion region{{tile.width(), tile.height(), kHalo}, {}, {}};
    const PartReader& reader = context.reader;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const int slot = context.layer.colour[channel];
        Plane<float>& reference = region.reference[channel] = make_region(region.extent);
        Plane<float>& test = region.test[channel] = make_region(region.extent);
        for (int row = 0; row < region.extent.padded_height(); ++row) {
            const int y = std::clamp(tile.y0 - kHalo + row, 0, reader.height() - 1);
            const float* const from[2] = {reader.floats(Side::kReference, slot, y),
                                          reader.floats(Side::kTest, slot, y)};
            for (int column = 0; column < region.extent.padded_width(); ++column) {
                const int x = std::clamp(tile.x0 - kHalo + column, 0, reader.width() - 1);
                float* const to[2] = {&reference.at(column, row), &test.at(column, row)};
                gather_pixel(context, x, y, from, to);
            }
        }
    }
    return region;
}

bool has_same_colours(const TileContext& context, const TileRect& tile) {
    const int x0 = std::max(tile.x0 - kHalo, 0);
    const int x1 = std::min(tile.x1 + kHalo, context.reader.width());
    const int y0 = std::max(tile.y0 - kHalo, 0);
    const int y1 = std::min(tile.y1 + kHalo, context.reader.height());
    for (const int slot : context.layer.colour)
        for (int y = y0; y < y1; ++y)
            if (!context.reader.is_same(slot, y, x0, x1)) return false;
    return true;
}

Plane3<float> to_coded(const Plane3<float>& colours, const TileContext& context,
                       const compare::Extent& extent) {
    return compare::transfer(
        colours,
        context.is_display_coded ? compare::Transfer::kClamp : compare::Transfer::kEncodeSrgb,
        extent);
}

Plane3<float> to_linear(const Plane3<float>& colours, const TileContext& context,
                        const compare::Extent& extent) {
    return compare::transfer(
        colours,
        context.is_display_coded ? compare::Transfer::kDecodeSrgb : compare::Transfer::kClamp,
        extent);
}

}  // namespace penumbra::diff
