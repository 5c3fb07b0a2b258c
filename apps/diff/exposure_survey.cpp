#include "apps/diff/exposure_survey.h"

#include <cmath>

#include "apps/diff/median.h"

namespace penumbra::diff {
namespace {

// Rec. 709 luminance of what HDR-FLIP sees: negative and non-finite values count as 0.
std::vector<float> luminances(const PartReader& reader, const std::vector<int>& colour, int y) {
    constexpr float kWeights[3] = {0.2126f, 0.7152f, 0.0722f};
    std::vector<float> row(static_cast<std::size_t>(reader.width()));
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const float* values = reader.floats(Side::kReference, colour[channel], y);
        for (std::size_t x = 0; x < row.size(); ++x)
            if (values[x] > 0 && std::isfinite(values[x])) row[x] += kWeights[channel] * values[x];
    }
    return row;
}

}  // namespace

std::vector<compare::Exposures> survey_exposures(const PartTiles& tiles,
                                                 const std::vector<LayerPair>& layers) {
    std::vector<StreamingMedian> medians(layers.size());
    for (const bool is_first : {true, false}) {
        tiles.for_each_band(layers, [&](const PartReader& reader, const SlotTable& table, int top,
                                        int bottom) {
            tiles.arena().for_each(static_cast<int>(layers.size()), [&](int index, int) {
                const auto layer = static_cast<std::size_t>(index);
                for (int y = top; y < bottom; ++y) {
                    const std::vector<float> row =
                        luminances(reader, table.layers[layer].colour, y);
                    is_first ? medians[layer].count_upper(row) : medians[layer].count_lower(row);
                }
            });
        });
        if (is_first)
            for (StreamingMedian& median : medians) median.choose_upper();
    }
    std::vector<compare::Exposures> exposures;
    for (const StreamingMedian& median : medians)
        exposures.push_back(compare::choose_exposures(static_cast<double>(median.median()),
                                                      static_cast<double>(median.largest())));
    return exposures;
}

}  // namespace penumbra::diff
