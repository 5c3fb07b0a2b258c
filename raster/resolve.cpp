#include "raster/resolve.h"

#include "raster/resolve_kernel.h"

namespace penumbra::raster {

void resolve(const SceneView& scene, const Geometry& geometry, const FrameContext& frame, Tile tile,
             VisibilityView visibility, const SurfaceView& surface) {
    const ResolveJob job{.camera = scene.camera,
                         .previous_camera = scene.previous_camera,
                         .background = scene.background,
                         .tile = tile,
                         .instances = geometry.tables.instances.data(),
                         .materials = geometry.tables.materials.data(),
                         .visibility = visibility,
                         .surface = surface};
    simd::pick(frame.isa, &avx2::resolve_tile, &avx512::resolve_tile)(job);
}

}  // namespace penumbra::raster
