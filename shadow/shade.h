#pragma once

#include "core/frame/light_sums.h"
#include "core/light/lobe_accuracy.h"
#include "shadow/lights.h"

namespace penumbra::shadow {

// The light without shadows, U, of a tile: the analytic half of pass 4. Per pixel, summed over the
// tile's lights in ascending order,
//
//     unshadowed_diffuse = base_color (1 - metallic) * sum radiance * lambert_form_factor
//     unshadowed_glossy  = ltc_specular_scale        * sum radiance * ltc_form_factor
//
// (core/light/polygon.h, core/light/ltc_table.h), over the directions above the horizon of the
// shading normal; what the geometric surface hides is the shadow rays' matter. `accuracy`
// is that of glossy light. Writes the two U planes of `sums` and nothing else; 0 where nothing is
// hit.
void shade(const SceneView& view, const TileLights& tile_lights, LobeAccuracy accuracy,
           const FrameContext& context, const ConstSurfaceView& surface, const LightSumsView& sums);

}  // namespace penumbra::shadow
