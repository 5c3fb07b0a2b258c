#include "apps/diff/part_tiles.h"

#include <algorithm>

#include "core/compare/flip.h"

namespace penumbra::diff {
namespace {

// Rows of both images that a band holds; at least one row of tiles, whatever it takes.
constexpr std::size_t kBandBytes = std::size_t{192} << 20;
constexpr int kLargestBand = 16 * kTileHeight;

}  // namespace

int band_height(int width, std::size_t slots) {
    const std::size_t row =
        static_cast<std::size_t>(width) * 4 * 2 * std::max<std::size_t>(slots, 1);
    const auto tiles = static_cast<int>(kBandBytes / row / kTileHeight);
    return std::clamp(tiles * kTileHeight, kTileHeight, kLargestBand);
}

SlotTable make_slots(const std::vector<LayerPair>& layers, const SourcePart& part) {
    SlotTable table;
    for (const LayerPair& layer : layers) {
        LayerSlots entry;
        for (std::size_t i = 0; i < layer.test_channels.size(); ++i) {
            const int channel = layer.reference.channels[i];
            entry.slots.push_back(static_cast<int>(table.slots.size()));
            table.slots.push_back({channel, layer.test_channels[i],
                                   part.channels[static_cast<std::size_t>(channel)].holds_ids()});
        }
        for (const int place : layer.reference.colour)
            entry.colour.push_back(entry.slots[static_cast<std::size_t>(place)]);
        table.layers.push_back(std::move(entry));
    }
    return table;
}

PartTiles::PartTiles(ImageSource& reference, ImageSource& test, int part,
                     const CompareSettings& settings, const parallel::Arena& arena)
    : reference_(reference),
      test_(test),
      part_(part),
      settings_(settings),
      arena_(arena),
      info_(reference.parts()[static_cast<std::size_t>(part)]) {}

TileRect PartTiles::rect_of(int tile) const {
    const int x = tile % columns() * kTileWidth, y = tile / columns() * kTileHeight;
    return {x, y, std::min(x + kTileWidth, info_.data.width()),
            std::min(y + kTileHeight, info_.data.height())};
}

void PartTiles::for_each(const std::vector<LayerPair>& layers, MetricSet metrics,
                         const std::vector<compare::Exposures>& exposures, const Body& body) const {
    const SlotTable table = make_slots(layers, info_);
    PartReader reader(reference_, test_, part_, table.slots, arena_);
    const int height = reader.height();
    const int band = band_height(reader.width(), table.slots.size());
    for (int top = 0; top < height; top += band) {
        const int bottom = std::min(top + band, height);
        reader.load(std::max(top - compare::kFlipHalo, 0),
                    std::min(bottom + compare::kFlipHalo, height));
        const int first = top / kTileHeight * columns();
        const int tiles = (bottom - top + kTileHeight - 1) / kTileHeight * columns();
        arena_.for_each(tiles * static_cast<int>(layers.size()), [&](int index, int) {
            const auto layer = static_cast<std::size_t>(index / tiles);
            const int tile = first + index % tiles;
            const TileContext context{
                .reader = reader,
                .layer = table.layers[layer],
                .mask = settings_.mask,
                .mask_x = info_.data.x0 - info_.display.x0,
                .mask_y = info_.data.y0 - info_.display.y0,
                .is_display_coded = reference_.is_display_coded(),
                .pixel_threshold = settings_.pixel_threshold,
                .metrics = metrics,
                .exposures = exposures.empty() ? compare::Exposures{} : exposures[layer]};
            body(context, layer, tile, rect_of(tile));
        });
    }
}

void PartTiles::for_each_band(const std::vector<LayerPair>& layers, const Band& body) const {
    const SlotTable table = make_slots(layers, info_);
    std::vector<Slot> slots = table.slots;
    for (Slot& slot : slots) slot.test_channel = slot.reference_channel;
    PartReader reader(reference_, reference_, part_, std::move(slots), arena_);
    const int band = band_height(reader.width(), table.slots.size());
    for (int top = 0; top < reader.height(); top += band) {
        const int bottom = std::min(top + band, reader.height());
        reader.load(top, bottom);
        body(reader, table, top, bottom);
    }
}

}  // namespace penumbra::diff
