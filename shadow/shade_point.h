#pragma once

#include "core/light/ltc_table.h"
#include "core/light/polygon.h"
#include "core/math/frame.h"

// The unshadowed light at shading points, one per lane, as the kernel and programs that are not
// ours call it.

namespace penumbra::shadow {

// A surface point that faces its viewer.
template <class F>
struct ShadingPoint {
    Vec3<F> position;  // world, metres
    Vec3<F> normal;    // shading normal, unit
    Vec3<F> eye;       // world
    Vec3<F> base_color;
    F roughness, metallic, dielectric_f0;
};

// What depends on the surface and the viewer, but not on the lights.
template <class F>
struct ShadingLobes {
    TransformedLobe<F> specular;  // unit mass over the sphere
    Vec3<F> diffuse_scale, specular_scale;
};

template <class F>
ShadingLobes<F> make_lobes(const ShadingPoint<F>& p, const float* table = kLtcTable) {
    const Vec3<F> to_eye = p.eye - p.position;
    const Vec3<F> view = to_eye * (F(1) / simd::sqrt(simd::max(length_squared(to_eye), F(1e-36f))));
    const LtcEntry<F> entry = ltc_lookup(p.roughness, dot(p.normal, view), table);
    const Frame<F> frame = frame_from_normal_and_view(p.normal, view);
    const Brdf<F> brdf = make_brdf(p.base_color, p.roughness, p.metallic, p.dielectric_f0);
    return {{fma(frame.tangent, entry.m00, frame.normal * entry.m02), frame.bitangent,
             fma(frame.tangent, entry.m20, frame.normal * entry.m22), entry.determinant},
            brdf.diffuse_albedo,
            ltc_specular_scale(entry, brdf.f0)};
}

// The unshadowed radiance towards the viewer, per lobe.
template <class F>
struct Unshadowed {
    Vec3<F> diffuse{F(0), F(0), F(0)};
    Vec3<F> glossy{F(0), F(0), F(0)};
};

// Adds one light's form factors times its radiance; the lobes' scales are still missing.
template <class F>
void add_light(const PolygonShape<float>& shape, const Vec3f& radiance, const SeenPolygon<F>& seen,
               const Vec3<F>& normal, const ShadingLobes<F>& lobes, Unshadowed<F>& sum) {
    const Vec3<F> light = broadcast<F>(radiance);
    const FormFactors<F> arriving = form_factors(shape, seen, normal, lobes.specular);
    sum.diffuse = fma(light, arriving.lambert, sum.diffuse);
    sum.glossy = fma(light, arriving.ltc, sum.glossy);
}

// The unshadowed light of one polygon at one point: radiance towards the viewer.
template <class F>
Unshadowed<F> unshadowed_light(const PolygonShape<float>& shape, const Vec3f& radiance,
                               const ShadingPoint<F>& point) {
    const SeenPolygon<F> seen = see_polygon(shape, point.position, point.normal);
    const ShadingLobes<F> lobes = make_lobes(point);
    Unshadowed<F> sum;
    add_light(shape, radiance, seen, point.normal, lobes, sum);
    return {sum.diffuse * lobes.diffuse_scale, sum.glossy * lobes.specular_scale};
}

}  // namespace penumbra::shadow
