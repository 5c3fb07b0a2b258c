#include "shadow/draw_lights.h"

#include "shadow/draw_lights_kernel.h"

namespace penumbra::shadow {

void draw_lights(const SceneView& view, const FrameContext& context, const Tile& tile,
                 const SurfaceView& surface) {
    PerLight<Drawn> drawn;
    const LightSetView lights = view.lights.view();
    for (std::uint32_t i = 0; i < view.lights.size(); ++i) {
        with_light(lights, i, [&]<class Shape>(const Lit<Shape>& light) {
            if (!light.visible || misses_tile(light.shape, view.camera, tile)) return;
            if (const auto outline = see_outline(light.shape, view.camera.eye))
                drawn.add(Drawn<Shape>{*outline, light.emission, light.previous_from_current});
        });
    }
    if (drawn.size() == 0) return;
    simd::pick(context.isa, &avx2::draw_lights_in_tile,
               &avx512::draw_lights_in_tile)({.lights = drawn.view(),
                                              .camera = view.camera,
                                              .previous_camera = view.previous_camera,
                                              .x0 = tile.x0,
                                              .y0 = tile.y0,
                                              .surface = surface});
}

}  // namespace penumbra::shadow
