#pragma once

#include "core/light/polygon_shape.h"

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

// With r the distance, e the point's distance from the light's plane and n.v the height above its
// horizon, the form factor is 1/pi * integral of e (n.v) / r^4 over the light's area. Each factor
// is bounded on its own: the height, linear in the light's point, and the largest distance by the
// vertices, the smallest distance by a ball around the light and by its plane.
template <class F>
FormFactorBounds<F> bound_form_factor(const SurfaceBall<F>& surface,
                                      const PolygonShape<float>& light) {
    const F area(light.area);
    F lowest(1e30f), highest(-1e30f), farthest(0);
    for (int i = 0; i < light.count; ++i) {
        const Vec3<F> to_vertex = broadcast<F>(light.vertices[i]) - surface.center;
        const F height = dot(surface.normal, to_vertex);
        lowest = simd::min(height, lowest);
        highest = simd::max(height, highest);
        farthest = simd::max(length_squared(to_vertex), farthest);
    }
    farthest = simd::sqrt(farthest) + surface.radius;
    const F height_slack =
        simd::fma(length(surface.normal), surface.radius, surface.normal_radius * farthest);
    const F height_high = highest + height_slack;
    const F height_low = simd::max(lowest - height_slack, F(0));

    const Vec3<F> to_light = broadcast<F>(light.center) - surface.center;
    F in_front = -dot(broadcast<F>(light.normal), to_light);
    if (light.two_sided) in_front = simd::abs(in_front);
    const F front_high = in_front + surface.radius;
    const F front_low = simd::max(in_front - surface.radius, F(0));
    // A little less than the plane says: the light is planar up to rounding only.
    const F nearest = simd::max(length(to_light) - (surface.radius + F(light.radius * 1.0001f)),
                                front_low * F(0.9999f));

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
