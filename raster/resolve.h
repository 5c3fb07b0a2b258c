#pragma once

#include "core/frame/surface.h"
#include "core/frame/visibility.h"
#include "raster/setup.h"

namespace penumbra::raster {

// Fills the G-buffer of one tile from its visibility buffer; see core/frame/surface.h for what each
// plane holds. Planes that are null are not wanted. Ids are kNothing where nothing is hit.
// `geometry` was prepared from `scene`. Lights without geometry are drawn over the result by
// shadow/draw_lights.h.
void resolve(const SceneView& scene, const Geometry& geometry, const FrameContext& frame, Tile tile,
             VisibilityView visibility, const SurfaceView& surface);

}  // namespace penumbra::raster
