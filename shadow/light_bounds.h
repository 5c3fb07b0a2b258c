#pragma once

#include "core/math/vec.h"

// Bounds on a light's form factor over a ball of points and a ball of normals.

namespace penumbra::shadow {

template <class F>
struct SurfaceBall {
    Vec3<F> center;  // of the points, world
    F radius;
    Vec3<F> normal;  // center of the shading normals
    F normal_radius;
};

template <class F>
struct FormFactorBounds {
    F lambert_high, lambert_low;  // of lambert_form_factor
    F solid_angle_high;           // of the light's part above the horizon
};

// The light is a ball (`light_center`, `light_radius`) that holds a polygon of `area` with unit
// normal `light_normal`. With r the distance, e the point's distance from the light's plane and n.v
// the height above its horizon, the form factor is 1/pi * integral of e (n.v) / r^4 over the area:
// each factor is bounded by the balls.
template <class F>
FormFactorBounds<F> bound_form_factor(const SurfaceBall<F>& surface, const Vec3<F>& light_center,
                                      F light_radius, const Vec3<F>& light_normal, F area,
                                      bool two_sided) {
    const Vec3<F> to_light = light_center - surface.center;
    const F distance = length(to_light);
    const F slack = surface.radius + light_radius;
    const F nearest = simd::max(distance - slack, F(0));
    const F farthest = distance + slack;

    F in_front = -dot(light_normal, to_light);
    if (two_sided) in_front = simd::abs(in_front);
    const F front_high = in_front + surface.radius;
    const F front_low = simd::max(in_front - surface.radius, F(0));

    const F height = dot(surface.normal, to_light);
    const F height_slack =
        simd::fma(length(surface.normal), slack, surface.normal_radius * farthest);
    const F height_high = height + height_slack;
    const F height_low = simd::max(height - height_slack, F(0));

    const auto none = (front_high <= F(0)) | (height_high <= F(0));
    const auto apart = nearest > F(0);
    const F inverse = F(1) / simd::select(apart, nearest, F(1));
    const F cosine_light = simd::min(front_high * inverse, F(1));
    const F cosine_surface = simd::min(height_high * inverse, F(1));
    F solid_angle = simd::select(apart, area * cosine_light * (inverse * inverse), F(6.2831855f));
    solid_angle = simd::min(solid_angle, F(6.2831855f));
    F high = simd::select(apart, solid_angle * cosine_surface * F(0.31830989f), F(1));
    high = simd::min(high, F(1));
    const F inverse_far = F(1) / simd::max(farthest, F(1e-18f));
    const F low = (area * (front_low * inverse_far) * (inverse_far * inverse_far)) *
                  (height_low * inverse_far * F(0.31830989f));
    return {simd::select(none, F(0), high), low, simd::select(none, F(0), solid_angle)};
}

}  // namespace penumbra::shadow
