#include "apps/renderer/tile_scratch.h"

namespace penumbra::renderer {
namespace {

Plane<float> plane() {
    return {kTileSize, kTileSize};
}
Plane3<float> plane3() {
    return make_plane3<float>(kTileSize, kTileSize);
}
Plane<std::uint32_t> ids() {
    return {kTileSize, kTileSize};
}

}  // namespace

TileScratch::TileScratch()
    : visible_instance_(ids()),
      visible_triangle_(ids()),
      position_(plane3()),
      shadow_origin_(plane3()),
      geometric_normal_(plane3()),
      normal_(plane3()),
      base_color_(plane3()),
      emission_(plane3()),
      roughness_(plane()),
      metallic_(plane()),
      dielectric_f0_(plane()),
      depth_(plane()),
      motion_x_(plane()),
      motion_y_(plane()),
      instance_(ids()),
      triangle_(ids()),
      material_(ids()),
      diffuse_(plane3()),
      glossy_(plane3()),
      shadowed_(plane3()),
      unshadowed_samples_(plane3()) {}

VisibilityView TileScratch::visibility() {
    return {.instance = visible_instance_.view(), .triangle = visible_triangle_.view()};
}

SurfaceView TileScratch::surface() {
    return {.position = view(position_),
            .shadow_origin = view(shadow_origin_),
            .geometric_normal = view(geometric_normal_),
            .normal = view(normal_),
            .base_color = view(base_color_),
            .roughness = roughness_.view(),
            .metallic = metallic_.view(),
            .dielectric_f0 = dielectric_f0_.view(),
            .emission = view(emission_),
            .depth = depth_.view(),
            .motion_x = motion_x_.view(),
            .motion_y = motion_y_.view(),
            .instance = instance_.view(),
            .triangle = triangle_.view(),
            .material = material_.view()};
}

LightSumsView TileScratch::sums() {
    return {.unshadowed_diffuse = view(diffuse_),
            .unshadowed_glossy = view(glossy_),
            .shadowed = view(shadowed_),
            .unshadowed_samples = view(unshadowed_samples_)};
}

void TileScratch::clear_samples() {
    for (Plane3<float>* planes : {&shadowed_, &unshadowed_samples_})
        for (Plane<float>& p : *planes) p.fill(0.0f);
}

}  // namespace penumbra::renderer
