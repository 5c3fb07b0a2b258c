#pragma once

#include <vector>

#include "apps/diff/part_tiles.h"
#include "apps/diff/report.h"
#include "apps/diff/tile_pictures.h"

namespace penumbra::diff {

// The layers of one part of two images of the same make-up, measured; the pictures that the
// settings wish for included. `heat` is raised to the part's errors; nullptr where nobody wants
// pictures.
[[nodiscard]] std::vector<LayerReport> compare_part(const PartTiles& tiles,
                                                    const std::vector<LayerPair>& layers,
                                                    HeatCanvas* heat);

}  // namespace penumbra::diff
