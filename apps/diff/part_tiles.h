#pragma once

#include <functional>
#include <vector>

#include "apps/diff/compare_files.h"
#include "apps/diff/layers.h"
#include "apps/diff/tile_metrics.h"

namespace penumbra::diff {

// A layer of one part in both images.
struct LayerPair {
    Layer reference;
    std::vector<int> test_channels;  // that correspond to reference.channels
};

// The slots of a reader for some layers, and where each layer finds its own.
struct SlotTable {
    std::vector<Slot> slots;
    std::vector<LayerSlots> layers;
};
[[nodiscard]] SlotTable make_slots(const std::vector<LayerPair>& layers, const SourcePart& part);

// Rows that are held at once: whole rows of tiles, and at least one.
[[nodiscard]] int band_height(int width, std::size_t slots);

// One part of two images of the same make-up, cut into tiles.
class PartTiles {
  public:
    PartTiles(ImageSource& reference, ImageSource& test, int part, const CompareSettings& settings,
              const parallel::Arena& arena);

    [[nodiscard]] const SourcePart& info() const { return info_; }
    [[nodiscard]] const CompareSettings& settings() const { return settings_; }
    [[nodiscard]] bool is_display_coded() const { return reference_.is_display_coded(); }
    [[nodiscard]] int count() const { return columns() * rows(); }

    using Body =
        std::function<void(const TileContext&, std::size_t layer, int tile, const TileRect& rect)>;
    // One pass over both images, from the top, by all threads. `exposures` are those of the layers,
    // or none.
    void for_each(const std::vector<LayerPair>& layers, MetricSet metrics,
                  const std::vector<compare::Exposures>& exposures, const Body& body) const;

    // One pass over the reference alone: bands of rows, in order, by the calling thread.
    using Band = std::function<void(const PartReader&, const SlotTable&, int top, int bottom)>;
    void for_each_band(const std::vector<LayerPair>& layers, const Band& body) const;
    [[nodiscard]] const parallel::Arena& arena() const { return arena_; }

  private:
    [[nodiscard]] int columns() const { return (info_.data.width() + kTileWidth - 1) / kTileWidth; }
    [[nodiscard]] int rows() const { return (info_.data.height() + kTileHeight - 1) / kTileHeight; }
    [[nodiscard]] TileRect rect_of(int tile) const;

    ImageSource& reference_;
    ImageSource& test_;
    int part_;
    const CompareSettings& settings_;
    const parallel::Arena& arena_;
    const SourcePart& info_;
};

}  // namespace penumbra::diff
