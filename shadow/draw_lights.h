#pragma once

#include "core/frame/frame_context.h"
#include "core/frame/surface.h"
#include "core/frame/tile.h"
#include "core/scene/scene_view.h"

// The camera's picture of the lights; the surfaces' is raster/resolve.h. It stands here because it
// reads the lights as shading does, and rooms do not include each other.

namespace penumbra::shadow {

// Draws the scene file's visible lights over a resolved tile: they have no geometry, so the
// rasterizer does not know them. Where the ray through a pixel's centre meets a visible light's
// emitting side in front of the surface and beyond the near plane, the pixel becomes the light:
// emission is its radiance, depth and position are its own, the normals turn to the viewer, base
// colour, roughness, metallic and F0 are 0 and the ids are kNothing, so that nothing is shaded
// there. A one-sided light is invisible from behind. Of several lights the nearest wins, at equal
// depth the first. The motion is the camera's and the light's.
void draw_lights(const SceneView& view, const FrameContext& context, const Tile& tile,
                 const SurfaceView& surface);

}  // namespace penumbra::shadow
