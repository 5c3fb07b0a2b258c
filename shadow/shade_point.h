#pragma once

#include "core/light/light_set.h"
#include "core/math/frame.h"
#include "shadow/light_kinds.h"

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
    TransformedLobe<F> fitted;  // unit mass over the hemisphere
    CosineSpaceLobe<F> exact;
    Vec3<F> diffuse_albedo, f0;
    F matte;  // the diffuse albedo's mean over the channels
};

template <class F>
ShadingLobes<F> make_lobes(const ShadingPoint<F>& p, const float* table = kLtcTable) {
    const F third = F(1.0f / 3);
    const Vec3<F> to_eye = p.eye - p.position;
    const Vec3<F> view = to_eye * (F(1) / simd::sqrt(simd::max(length_squared(to_eye), F(1e-36f))));
    const LtcEntry<F> entry = ltc_lookup(p.roughness, dot(p.normal, view), table);
    const Frame<F> frame = frame_from_normal_and_view(p.normal, view);
    const Brdf<F> brdf = make_brdf(p.base_color, p.roughness, p.metallic, p.dielectric_f0);
    const Vec3<F> local_view{dot(frame.tangent, view), F(0), dot(p.normal, view)};
    return {{fma(frame.tangent, entry.m00, frame.normal * entry.m02), frame.bitangent,
             frame.normal * entry.m22, entry.determinant()},
            make_cosine_space_lobe(entry, brdf.alpha, local_view,
                                   (brdf.f0.x + brdf.f0.y + brdf.f0.z) * third),
            brdf.diffuse_albedo,
            brdf.f0,
            (brdf.diffuse_albedo.x + brdf.diffuse_albedo.y + brdf.diffuse_albedo.z) * third};
}

// Sums over lights of radiance times integrals of the lobes: Lambert's, and the two terms of
// Schlick's Fresnel. What depends on the surface's colors is still missing.
template <class F>
struct ArrivingLight {
    Vec3<F> lambert{F(0), F(0), F(0)};
    Vec3<F> plain{F(0), F(0), F(0)};    // to be multiplied with F0
    Vec3<F> fresnel{F(0), F(0), F(0)};  // and with 1
};

// The unshadowed radiance towards the viewer, per lobe.
template <class F>
struct Unshadowed {
    Vec3<F> diffuse{F(0), F(0), F(0)};
    Vec3<F> glossy{F(0), F(0), F(0)};
};

// `seen` is the light as the point sees it.
template <class F, class Shape, class Seen>
void add_light(const Lit<Shape>& light, const Seen& seen, const Vec3<F>& normal,
               const ShadingLobes<F>& lobes, LobeAccuracy accuracy, ArrivingLight<F>& sum) {
    typename LightTypes<Shape, F>::InCosineSpace in_cosine_space;
    const FormFactors<F> factors =
        form_factors(light.shape, seen, normal, lobes.fitted, in_cosine_space);
    const LobeIntegral<F> glossy = integrate_lobe(
        lobes.exact, in_cosine_space,
        RatioDemand<F>{seen.lit, factors.ltc, lobes.matte * factors.lambert, accuracy});
    const Vec3<F> radiance = broadcast<F>(light.emission.radiance);
    sum.lambert = fma(radiance, factors.lambert, sum.lambert);
    sum.plain = fma(radiance, glossy.plain - glossy.fresnel, sum.plain);
    sum.fresnel = fma(radiance, glossy.fresnel, sum.fresnel);
}

template <class F>
Unshadowed<F> reflect(const ShadingLobes<F>& lobes, const ArrivingLight<F>& light) {
    return {lobes.diffuse_albedo * light.lambert, lobes.f0 * light.plain + light.fresnel};
}

// The unshadowed light of one light at one point: radiance towards the viewer.
template <class F, class Shape>
Unshadowed<F> unshadowed_light(const Lit<Shape>& light, const ShadingPoint<F>& point,
                               LobeAccuracy accuracy = LobeAccuracy::kExact) {
    const auto seen = see(light.shape, point.position, point.normal);
    const ShadingLobes<F> lobes = make_lobes(point);
    ArrivingLight<F> sum;
    add_light(light, seen, point.normal, lobes, accuracy, sum);
    return reflect(lobes, sum);
}

}  // namespace penumbra::shadow
