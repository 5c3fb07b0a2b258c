#pragma once

#include "core/frame/camera.h"
#include "core/frame/surface.h"
#include "core/light/light_set.h"
#include "shadow/light_kinds.h"

namespace penumbra::shadow {

// A light that this tile may show, as seen from the eye.
template <class Shape>
struct Drawn {
    LightOutline<Shape> outline;
    Emission emission;
    Affine3f previous_from_current;
};

struct DrawJob {
    PerLightView<Drawn> lights;
    Camera camera, previous_camera;
    int x0, y0;  // of the tile, pixels of the frame
    SurfaceView surface;
};

}  // namespace penumbra::shadow

namespace penumbra::avx2 {
void draw_lights_in_tile(const shadow::DrawJob& job);
}
namespace penumbra::avx512 {
void draw_lights_in_tile(const shadow::DrawJob& job);
}
