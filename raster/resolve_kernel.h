#pragma once

#include "core/frame/surface.h"
#include "core/frame/visibility.h"
#include "raster/scene_tables.h"

namespace penumbra::raster {

struct ResolveJob {
    Camera camera, previous_camera;
    Vec3f background;
    Tile tile;
    const InstanceTable* instances;
    const MaterialTable* materials;
    VisibilityView visibility;
    SurfaceView surface;
};

}  // namespace penumbra::raster

namespace penumbra::avx2 {
void resolve_tile(const raster::ResolveJob& job);
}
namespace penumbra::avx512 {
void resolve_tile(const raster::ResolveJob& job);
}
