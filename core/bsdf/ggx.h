#pragma once

#include "core/math/elementary.h"
#include "core/math/vec.h"

// The material of penumbra: Lambert + GGX, as templates over the lane type (and double).
//
//     brdf = base_color (1 - metallic) / pi  +  D(h) F(v.h) G2(v, l) / (4 n.v n.l)
//
// D is the isotropic GGX distribution with alpha = roughness^2, G2 Smith's height-correlated
// masking-shadowing (Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based
// BRDFs", 2014, eq. 99), F Schlick's Fresnel F0 + (1 - F0) (1 - v.h)^5. The diffuse lobe is not
// scaled by 1 - F.
//
// Directions are unit vectors in the shading frame (z is the normal) that point away from the
// surface. Nothing here divides by a cosine: all results are finite for z >= 0, grazing included.

namespace penumbra {

inline constexpr double kOneOverPi = 0.318309886183790672;  // double, so that F may be

// Rougher than a mirror: alpha = 0.0025 is a highlight of 0.14 degrees, below a pixel in almost
// every picture, and float still resolves its peak D = 1 / (pi alpha^2) = 5e4. Resolve clamps to
// it, and the table of linearly transformed cosines begins there.
inline constexpr float kMinimumRoughness = 0.05f;

// What the surface is at one point. Alpha is roughness squared.
template <class F>
struct Brdf {
    Vec3<F> diffuse_albedo;  // base_color (1 - metallic)
    Vec3<F> f0;              // reflectance at normal incidence, per channel
    F alpha;
};

// `dielectric_f0` is ((ior - 1) / (ior + 1))^2; metals take F0 from the base colour.
template <class F>
Brdf<F> make_brdf(const Vec3<F>& base_color, const F& roughness, const F& metallic,
                  const F& dielectric_f0) {
    const F dielectric = (F(1) - metallic) * dielectric_f0;
    const F clamped = simd::clamp(roughness, F(kMinimumRoughness), F(1));
    return {base_color * (F(1) - metallic),
            {simd::fma(base_color.x, metallic, dielectric),
             simd::fma(base_color.y, metallic, dielectric),
             simd::fma(base_color.z, metallic, dielectric)},
            clamped * clamped};
}

// Schlick's (1 - v.h)^5, of a cosine in [0, 1].
template <class F>
F schlick_weight(const F& view_half) {
    const F miss = F(1) - view_half;
    const F miss2 = miss * miss;
    return miss2 * miss2 * miss;
}

// The specular lobe at one pair of directions.
template <class F>
struct GgxLobe {
    F brdf_times_cosine;  // D G2 / (4 n.v n.l) * n.l, without Fresnel; 0 below the horizon
    F fresnel_weight;     // (1 - v.h)^5
    F density;            // of ggx_sample_direction, per steradian; also below the horizon
};

// The root in Smith's Lambda: sqrt(alpha^2 + (1 - alpha^2) cos^2), in [alpha, 1].
template <class F>
F ggx_smith_root(const F& alpha, const F& cosine) {
    const F alpha2 = alpha * alpha;
    return simd::sqrt(simd::fma(F(1) - alpha2, cosine * cosine, alpha2));
}

// D of the half vector h of any length. The squared sine comes from its x and y instead of
// 1 - cos^2, which in float has no digits left inside a narrow highlight.
template <class F>
F ggx_distribution(const F& alpha, const Vec3<F>& h) {
    const F alpha2 = alpha * alpha;
    const F sine2 = simd::fma(h.x, h.x, h.y * h.y);
    const F cosine2 = h.z * h.z;
    const F stretched = simd::max(simd::fma(alpha2, cosine2, sine2), F(1e-24f));
    const F ratio = (sine2 + cosine2) / stretched;
    return simd::select(h.z > F(0), F(kOneOverPi) * alpha2 * ratio * ratio, F(0));
}

template <class F>
GgxLobe<F> ggx_evaluate(const F& alpha, const Vec3<F>& view, const Vec3<F>& direction) {
    const Vec3<F> half = view + direction;
    const F distribution = ggx_distribution(alpha, half);
    const F cos_view = simd::max(view.z, F(0));
    const F cos_light = simd::max(direction.z, F(0));
    const F root_view = ggx_smith_root(alpha, cos_view);
    const F masking = simd::fma(cos_light, root_view, cos_view * ggx_smith_root(alpha, cos_light));
    // |v + l| = 2 v.h for unit vectors.
    const F view_half = simd::min(F(0.5f) * length(half), F(1));
    GgxLobe<F> lobe{};
    lobe.brdf_times_cosine = F(0.5f) * distribution * (cos_light / simd::max(masking, F(1e-24f)));
    lobe.fresnel_weight = schlick_weight(view_half);
    lobe.density = F(0.5f) * distribution / (cos_view + root_view);
    return lobe;
}

// A microfacet normal as the view sees them, distributed as D G1 max(0, v.h) / v.z. Dupuy and
// Benyoub, "Sampling Visible GGX Normals with Spherical Caps" (2023): where alpha is 1, the
// mirrored directions fill the cap z > -v.z evenly. `random` is in [0, 1)^2; its x goes outwards
// from the mirror direction.
template <class F>
Vec3<F> ggx_sample_visible_normal(const F& alpha, const Vec3<F>& view, const Vec2<F>& random) {
    const Vec3<F> stretched =
        normalize(Vec3<F>{alpha * view.x, alpha * view.y, simd::max(view.z, F(0))});
    const F cap_height = F(1) + stretched.z;
    const F below_top = random.x * cap_height;
    const F radius = simd::sqrt(simd::max(below_top * (F(2) - below_top), F(0)));
    F sine, cosine;
    sincos_two_pi(random.y, sine, cosine);
    // 1 - random.x instead of the difference of heights keeps the digits of normals at grazing.
    const F half_z = simd::max(cap_height * (F(1) - random.x), F(1e-7f));
    return normalize(Vec3<F>{alpha * simd::fma(radius, cosine, stretched.x),
                             alpha * simd::fma(radius, sine, stretched.y), half_z});
}

// The view mirrored at such a normal: a direction with the density of ggx_evaluate. It may lie
// below the horizon, where the lobe is 0.
template <class F>
Vec3<F> ggx_sample_direction(const F& alpha, const Vec3<F>& view, const Vec2<F>& random) {
    const Vec3<F> normal = ggx_sample_visible_normal(alpha, view, random);
    return fma(normal, F(2) * dot(view, normal), -view);
}

// Specular BRDF times cosine, per channel.
template <class F>
Vec3<F> ggx_specular_times_cosine(const GgxLobe<F>& lobe, const Vec3<F>& f0) {
    const F rest = F(1) - lobe.fresnel_weight;
    return Vec3<F>{simd::fma(f0.x, rest, lobe.fresnel_weight),
                   simd::fma(f0.y, rest, lobe.fresnel_weight),
                   simd::fma(f0.z, rest, lobe.fresnel_weight)} *
           lobe.brdf_times_cosine;
}

// Diffuse BRDF times cosine, per channel.
template <class F>
Vec3<F> lambert_times_cosine(const Vec3<F>& diffuse_albedo, const F& cos_light) {
    return diffuse_albedo * (F(kOneOverPi) * simd::max(cos_light, F(0)));
}

}  // namespace penumbra
