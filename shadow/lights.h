#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/frame/frame_context.h"
#include "core/frame/surface.h"
#include "core/scene/scene_view.h"

// The choice of the lights that matter to a tile.

namespace penumbra::shadow {

// One worker's choice of lights for a tile. Memory is kept from tile to tile.
class TileLights {
  public:
    // Indices into SceneView::lights, ascending.
    [[nodiscard]] std::span<const std::uint32_t> kept() const { return kept_; }

  private:
    friend void cull_lights(const SceneView& view, const FrameContext& context,
                            const ConstSurfaceView& surface, float tolerance, TileLights& tile);
    std::vector<std::uint32_t> kept_, order_;
    std::vector<float> upper_, lower_, rank_;
};

// Chooses the lights of a tile; `tolerance` 0 keeps all, and so do scenes of up to 3 lights.
// Otherwise leaves out lights that provably reach no pixel of the tile, and of the others the
// dimmest, as long as this holds at every pixel:
//
//     luminance of the culled lights' U <= tolerance * luminance of the kept lights' U,
//
// U being diffuse + glossy. It is a guarantee: upper bounds of the culled lights against lower
// bounds of the kept ones' diffuse part, over the positions, normals and materials of each 16 x 16
// block. Where such a lower bound is zero (metals, black surfaces, blocks that the kept lights
// reach only in part) only lights that reach nothing are left out. A function of the tile's surface
// and the lights alone.
void cull_lights(const SceneView& view, const FrameContext& context,
                 const ConstSurfaceView& surface, float tolerance, TileLights& tile);

}  // namespace penumbra::shadow
