#pragma once

#include "core/frame/light_sums.h"
#include "core/frame/surface.h"
#include "core/frame/visibility.h"
#include "raster/rasterize.h"
#include "shadow/rays.h"
#include "shadow/shade.h"

namespace penumbra::renderer {

// One worker's memory for a tile: everything between the passes of a tile stays in cache.
class TileScratch {
  public:
    TileScratch();

    [[nodiscard]] VisibilityView visibility();
    [[nodiscard]] SurfaceView surface();
    [[nodiscard]] LightSumsView sums();
    void clear_samples();  // S_N and U_N, which the lights' rays add to

    raster::Scratch raster;
    shadow::RayScratch rays;
    shadow::TileLights lights;

  private:
    Plane<std::uint32_t> visible_instance_, visible_triangle_;
    Plane3<float> position_, shadow_origin_, geometric_normal_, normal_, base_color_, emission_;
    Plane<float> roughness_, metallic_, dielectric_f0_, depth_, motion_x_, motion_y_;
    Plane<std::uint32_t> instance_, triangle_, material_;
    Plane3<float> diffuse_, glossy_, shadowed_, unshadowed_samples_;
};

}  // namespace penumbra::renderer
