#pragma once

#include <vector>

#include "apps/diff/part_tiles.h"
#include "apps/diff/report.h"
#include "apps/diff/tile_pictures.h"

namespace penumbra::diff {

// One more pass over the layers that differ: raises the map of all errors, and draws the pictures
// that the settings wish for into the layers' reports.
void draw_part(const PartTiles& tiles, const std::vector<LayerPair>& layers,
               std::vector<LayerReport>& reports, HeatCanvas& all);

}  // namespace penumbra::diff
