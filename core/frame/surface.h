#pragma once

#include "core/frame/tile.h"

namespace penumbra {

// The G-buffer, one plane per number. Where nothing is hit: ids are kNothing, `depth` 1e10,
// `emission` the background, the rest 0.
template <class T, class Id>
struct SurfacePlaneViews {
    PlaneView3<T> position;       // world, metres
    PlaneView3<T> shadow_origin;  // position, moved off smooth-shaded facets (Hanika 2021); where
                                  // shadow rays start
    PlaneView3<T> geometric_normal;  // unit, world, towards the viewer
    PlaneView3<T> normal;  // shading normal: unit, world, n.v > 0 and above the geometric horizon
                           // where possible
    PlaneView3<T> base_color;
    PlaneView<T> roughness;  // >= kMinimumRoughness
    PlaneView<T> metallic;
    PlaneView<T> dielectric_f0;  // ((ior - 1) / (ior + 1))^2
    PlaneView3<T> emission;      // radiance of the surface itself (emissive faces on their emitting
                                 // side); the background where nothing is hit
    PlaneView<T> depth;          // along the view axis, metres
    PlaneView<T> motion_x, motion_y;  // pixel now - pixel in the previous frame
    PlaneView<Id> instance, triangle, material;
};
using SurfaceView = SurfacePlaneViews<float, std::uint32_t>;
using ConstSurfaceView = SurfacePlaneViews<const float, const std::uint32_t>;

inline ConstSurfaceView to_const(const SurfaceView& s) {
    return {.position = to_const(s.position),
            .shadow_origin = to_const(s.shadow_origin),
            .geometric_normal = to_const(s.geometric_normal),
            .normal = to_const(s.normal),
            .base_color = to_const(s.base_color),
            .roughness = s.roughness,
            .metallic = s.metallic,
            .dielectric_f0 = s.dielectric_f0,
            .emission = to_const(s.emission),
            .depth = s.depth,
            .motion_x = s.motion_x,
            .motion_y = s.motion_y,
            .instance = s.instance,
            .triangle = s.triangle,
            .material = s.material};
}

inline constexpr float kDepthOfNothing = 1e10f;

}  // namespace penumbra
