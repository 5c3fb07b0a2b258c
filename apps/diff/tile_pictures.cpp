#include "apps/diff/tile_pictures.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "apps/diff/colour_region.h"
#include "core/image/srgb.h"

namespace penumbra::diff {
namespace {

constexpr int kLargestSide = 4096;
constexpr double kVisibleError = 0.08;

constexpr int kNoLimit = 1 << 18;

int reduction_of(int width, int height, int limit) {
    int reduction = 1;
    while (reduction < limit && std::max(width, height) > kLargestSide * reduction) reduction *= 2;
    return reduction;
}

using Rgb = std::array<std::uint8_t, 3>;

// Data that is no colour: -infinity to infinity become black to white, 0 mid-grey.
std::uint8_t grey_of_number(float value) {
    if (std::isnan(value)) return 255;
    const float bounded =
        std::isinf(value) ? std::copysign(1.0f, value) : value / (1 + std::abs(value));
    return static_cast<std::uint8_t>(std::lround(127.5f + 127.5f * bounded));
}

// Ids as colours that tell neighbours apart (a multiplicative hash).
Rgb colour_of_id(std::uint32_t id) {
    const std::uint32_t mixed = (id + 1) * 2654435761u;
    return {static_cast<std::uint8_t>(mixed >> 24), static_cast<std::uint8_t>(mixed >> 16),
            static_cast<std::uint8_t>(mixed >> 8)};
}

std::uint8_t shown_colour(const TileContext& context, float value) {
    if (!context.is_display_coded) return image::srgb8_from_linear(value);
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255));
}

Rgb pixel_colour(const TileContext& context, Side side, int x, int y) {
    const PartReader& reader = context.reader;
    const LayerSlots& layer = context.layer;
    const int first = layer.slots.front();
    if (layer.colour.empty() && reader.slot(first).holds_ids)
        return colour_of_id(reader.ids(side, first, y)[x]);
    Rgb rgb{};
    for (std::size_t i = 0; i < 3; ++i) {
        if (!layer.colour.empty()) {
            const float value = reader.floats(side, layer.colour[i], y)[x];
            if (!std::isfinite(value)) return {255, 0, 255};
            rgb[i] = shown_colour(context, value);
            continue;
        }
        const std::size_t count = layer.slots.size();
        const int slot = layer.slots[count == 1 ? 0 : std::min(i, count - 1)];
        if (!reader.slot(slot).holds_ids) rgb[i] = grey_of_number(reader.floats(side, slot, y)[x]);
    }
    return rgb;
}

image::Picture draw_side(const TileContext& context, const TileRect& tile, Side side) {
    image::Picture picture{tile.width(), tile.height(), 3, {}};
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
            const Rgb rgb = pixel_colour(context, side, x, y);
            picture.bytes.insert(picture.bytes.end(), rgb.begin(), rgb.end());
        }
    return picture;
}

double heat_of_data(const TileContext& context, int x, int y) {
    double largest = 0;
    for (const int slot : context.layer.slots)
        largest = std::max(largest, relative_difference(context, slot, x, y));
    return largest;
}

bool pixel_differs(const TileContext& context, int x, int y) {
    return std::any_of(context.layer.slots.begin(), context.layer.slots.end(), [&](int slot) {
        if (values_differ(context, slot, x, y)) return true;
        return !context.reader.slot(slot).holds_ids &&
               !std::isfinite(context.reader.floats(Side::kReference, slot, y)[x]);
    });
}

bool is_finite_pixel(const TileContext& context, int x, int y) {
    for (const int slot : context.layer.slots) {
        if (context.reader.slot(slot).holds_ids) continue;
        for (const Side side : {Side::kReference, Side::kTest})
            if (!std::isfinite(context.reader.floats(side, slot, y)[x])) return false;
    }
    return true;
}

std::vector<std::uint8_t> draw_heat(const TileContext& context, const TileRect& tile) {
    const bool is_colour = !context.layer.colour.empty();
    Plane<float> flip(tile.width(), tile.height());
    if (is_colour && !has_same_colours(context, tile)) {
        const ColourRegion region = gather_colours(context, tile);
        compare::flip_map(to_linear(region.reference, context, region.extent),
                          to_linear(region.test, context, region.extent), region.extent, flip);
    }
    std::vector<std::uint8_t> heat;
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
            double value = is_colour ? static_cast<double>(flip.at(x - tile.x0, y - tile.y0))
                                     : heat_of_data(context, x, y);
            if (!context.counts(x, y))
                value = 0;
            else if (!is_finite_pixel(context, x, y))
                value = 1;
            else if (pixel_differs(context, x, y))
                value = std::max(value, kVisibleError);
            heat.push_back(
                static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255)));
        }
    return heat;
}

}  // namespace

TilePictures draw_tile(const TileContext& context, const TileRect& tile) {
    return {draw_side(context, tile, Side::kReference), draw_side(context, tile, Side::kTest),
            draw_heat(context, tile)};
}

image::Picture colour_map(const std::vector<std::uint8_t>& heat, int width, int height) {
    constexpr float kStops[6][3] = {{0, 0, 0},      {60, 20, 120},   {150, 40, 130},
                                    {225, 75, 100}, {255, 170, 100}, {255, 255, 200}};
    image::Picture picture{width, height, 3, {}};
    picture.bytes.reserve(3 * heat.size());
    for (const std::uint8_t value : heat) {
        const int stop = std::min(value / 51, 4);
        const float along = static_cast<float>(value - 51 * stop) / 51;
        for (int i = 0; i < 3; ++i)
            picture.bytes.push_back(static_cast<std::uint8_t>(
                kStops[stop][i] + along * (kStops[stop + 1][i] - kStops[stop][i])));
    }
    return picture;
}

PictureCanvas::PictureCanvas(int width, int height)
    : reduction_(reduction_of(width, height, kTileHeight)),  // tiles begin at whole pixels
      width_((width + reduction_ - 1) / reduction_),
      height_((height + reduction_ - 1) / reduction_) {
    picture_ = {width_, height_, 3, {}};
    picture_.bytes.resize(static_cast<std::size_t>(width_) * height_ * 3);
}

void PictureCanvas::place(const image::Picture& tile, int x0, int y0) {
    const int n = reduction_;
    for (int y = 0; y < tile.height; y += n)
        for (int x = 0; x < tile.width; x += n)
            for (int channel = 0; channel < 3; ++channel) {
                int sum = 0, count = 0;
                for (int v = y; v < std::min(y + n, tile.height); ++v)
                    for (int u = x; u < std::min(x + n, tile.width); ++u, ++count)
                        sum += tile.bytes[static_cast<std::size_t>((v * tile.width + u) * 3 +
                                                                   channel)];
                const std::size_t to =
                    (static_cast<std::size_t>((y0 + y) / n) * width_ + (x0 + x) / n) * 3;
                picture_.bytes[to + channel] = static_cast<std::uint8_t>((sum + count / 2) / count);
            }
}

HeatCanvas::HeatCanvas(const image::Window& window, int reduction)
    : window_(window),
      reduction_(reduction),
      width_((window.width() + reduction - 1) / reduction),
      height_((window.height() + reduction - 1) / reduction),
      heat_(static_cast<std::size_t>(width_) * height_) {}

HeatCanvas::HeatCanvas(const image::Window& window)
    : HeatCanvas(window, reduction_of(window.width(), window.height(), kNoLimit)) {}

void HeatCanvas::place(const std::vector<std::uint8_t>& tile, const TileRect& at, int x0, int y0) {
    std::size_t from = 0;
    for (int y = at.y0 + y0 - window_.y0; y < at.y1 + y0 - window_.y0; ++y)
        for (int x = at.x0 + x0 - window_.x0; x < at.x1 + x0 - window_.x0; ++x, ++from) {
            const std::size_t to =
                static_cast<std::size_t>(y / reduction_) * width_ + x / reduction_;
            const std::atomic_ref<std::uint8_t> shared(heat_[to]);
            std::uint8_t present = shared.load(std::memory_order_relaxed);
            while (present < tile[from] &&
                   !shared.compare_exchange_weak(present, tile[from], std::memory_order_relaxed)) {
            }
        }
}

}  // namespace penumbra::diff
