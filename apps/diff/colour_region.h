#pragma once

#include "apps/diff/tile_metrics.h"
#include "core/compare/separable.h"

namespace penumbra::diff {

// The colours of both images in a tile and its halo, as the perceptual metrics want them: where a
// pixel does not count or is not finite, both have the reference's colour (or black).
struct ColourRegion {
    compare::Extent extent;
    Plane3<float> reference, test;  // as in the files
};

[[nodiscard]] ColourRegion gather_colours(const TileContext& context, const TileRect& tile);

// Are both images the same in the tile and its halo? Then FLIP is 0 and SSIM 1, exactly.
[[nodiscard]] bool has_same_colours(const TileContext& context, const TileRect& tile);

// Display-coded and linear values in [0, 1].
[[nodiscard]] Plane3<float> to_coded(const Plane3<float>& colours, const TileContext& context,
                                     const compare::Extent& extent);
[[nodiscard]] Plane3<float> to_linear(const Plane3<float>& colours, const TileContext& context,
                                      const compare::Extent& extent);

}  // namespace penumbra::diff
