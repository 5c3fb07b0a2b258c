#pragma once

#include <functional>
#include <optional>
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

// One part of two images of the same make-up, and the passes over it.
class PartComparison {
  public:
    PartComparison(ImageSource& reference, ImageSource& test, int part,
                   const CompareSettings& settings, const parallel::Arena& arena);

    // The measured layers, pictures included where the settings wish for them. `heat`, the error
    // map over all layers, is drawn for the first part.
    [[nodiscard]] std::vector<LayerReport> run(std::vector<LayerPair> layers,
                                               std::optional<image::Picture>* heat);

  private:
    using Body =
        std::function<void(const TileContext&, std::size_t layer, int tile, const TileRect& rect)>;
    void for_each_tile(const std::vector<LayerPair>& layers, MetricSet metrics,
                       const std::vector<compare::Exposures>& exposures, const Body& body);
    [[nodiscard]] std::vector<TileSums> measure(const std::vector<LayerPair>& layers,
                                                MetricSet metrics,
                                                const std::vector<compare::Exposures>& exposures,
                                                std::vector<std::vector<Block>>* blocks);
    void measure_hdr(const std::vector<LayerPair>& layers, std::vector<LayerReport>& reports);
    [[nodiscard]] std::vector<compare::Exposures> survey(const std::vector<LayerPair>& layers);
    void draw(const std::vector<LayerPair>& layers, std::vector<LayerReport>& reports,
              std::optional<image::Picture>* heat);
    [[nodiscard]] LayerReport to_report(const LayerPair& layer, const TileSums& sums,
                                        std::vector<Block> blocks) const;

    ImageSource& reference_;
    ImageSource& test_;
    int part_;
    const CompareSettings& settings_;
    const parallel::Arena& arena_;
    const SourcePart& info_;
};

}  // namespace penumbra::diff
