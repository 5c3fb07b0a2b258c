#include "shadow/shade.h"

#include "shadow/shade_kernel.h"

namespace penumbra::shadow {

void shade(const SceneView& view, const TileLights& tile_lights, LobeAccuracy accuracy,
           const FrameContext& context, const ConstSurfaceView& surface,
           const LightSumsView& sums) {
    const std::span<const std::uint32_t> kept = tile_lights.kept();
    simd::pick(context.isa, &avx2::shade_tile,
               &avx512::shade_tile)({.lights = view.lights.view(),
                                     .kept = kept.data(),
                                     .kept_count = static_cast<int>(kept.size()),
                                     .eye = view.camera.eye,
                                     .accuracy = accuracy,
                                     .surface = surface,
                                     .sums = sums});
}

}  // namespace penumbra::shadow
