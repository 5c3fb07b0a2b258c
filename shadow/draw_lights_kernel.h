#pragma once

#include "core/frame/camera.h"
#include "core/frame/surface.h"
#include "core/light/clip.h"
#include "core/math/affine.h"

namespace penumbra::shadow {

// A light that this tile may show, as seen from the eye.
struct DrawnLight {
    int edge_count;
    Vec3f
        edge_normals[kMaxPolygonVertices];  // a direction meets the light if no dot product is < 0
    Vec3f normal;                           // unit, towards the viewer
    float plane_distance;                   // normal . (point of the light - eye), < 0
    Vec3f radiance;
    Affine3f previous_from_current;
};

struct DrawJob {
    const DrawnLight* lights;
    int light_count;
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
