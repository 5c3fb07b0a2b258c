#pragma once

#include <vector>

#include "apps/diff/part_tiles.h"

namespace penumbra::diff {

// HDR-FLIP's exposures for each of the layers, which have colours: from the brightest and the
// median luminance of the reference, in two passes over it.
[[nodiscard]] std::vector<compare::Exposures> survey_exposures(
    const PartTiles& tiles, const std::vector<LayerPair>& layers);

}  // namespace penumbra::diff
