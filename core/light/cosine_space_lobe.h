#pragma once

#include "core/bsdf/ggx.h"
#include "core/light/ltc_table.h"

// The GGX lobe in the space where a linearly transformed cosine D that was fitted to it is the
// clamped cosine: lobe / D there is a smooth function, whatever the roughness.

namespace penumbra {

// The GGX lobe as cosine space sees it. Directions there map to (x - shear z, scale_y y, scale_z z)
// in the shading frame, up to a factor.
template <class F>
struct CosineSpaceLobe {
    F shear, scale_y, scale_z;
    F view_sine, view_cosine;
    F squared_alpha, root_view;  // ggx_smith_root of the view
    F constant;                  // of lobe / D
    F norm, fresnel;             // albedos, as in LtcEntry
    F f0;                        // mean over the channels, for the spread alone
};

// `view` in the shading frame; its y is 0.
template <class F>
CosineSpaceLobe<F> make_cosine_space_lobe(const LtcEntry<F>& entry, const F& alpha,
                                          const Vec3<F>& view, const F& f0) {
    const F inverse = F(1) / entry.m22;
    const F cosine = simd::max(view.z, F(0));
    // D = m22 / (pi m00^2) z |M p|^3 / |p|^4 with M scaled as above; the lobe's own factor is
    // alpha^2 / (2 pi).
    const F scale_z = entry.m00 * inverse;
    return {entry.m02 * inverse,
            entry.m00,
            scale_z,
            view.x,
            cosine,
            alpha * alpha,
            ggx_smith_root(alpha, cosine),
            F(0.5f) * (alpha * alpha) * entry.m00 * (scale_z * scale_z),
            entry.norm,
            entry.fresnel,
            f0};
}

namespace detail {

// Means over the light: of lobe / D, and of that times Schlick's (1 - v.h)^5.
template <class F>
struct LobeRatio {
    F plain, fresnel;
};

template <class F>
struct RatioSums {
    F weight = F(0), plain = F(0), fresnel = F(0), square = F(0);
};

// One point of the polygon, at `p` in cosine space, near the length that it has as a mean of unit
// vectors. `share` is the part of the polygon that it stands for, area times height.
template <class F>
void add_point(const CosineSpaceLobe<F>& lobe, const Vec3<F>& p, const F& share,
               RatioSums<F>& sums) {
    const F squared = simd::max(length_squared(p), F(1e-12f));
    Vec3<F> direction{simd::fma(-lobe.shear, p.z, p.x), lobe.scale_y * p.y, lobe.scale_z * p.z};
    const F inverse = F(1) / simd::sqrt(simd::max(length_squared(direction), F(1e-30f)));
    direction = direction * inverse;
    const F half_x = direction.x + lobe.view_sine;
    const F half_z = direction.z + lobe.view_cosine;
    const F sine2 = simd::fma(half_x, half_x, direction.y * direction.y);
    const F cosine2 = half_z * half_z;
    const F half2 = sine2 + cosine2;
    const F stretched = simd::max(simd::fma(lobe.squared_alpha, cosine2, sine2), F(1e-12f));
    const F height2 = direction.z * direction.z;
    const F root = simd::sqrt(simd::fma(lobe.squared_alpha, F(1) - height2, height2));
    const F masking =
        simd::max(simd::fma(direction.z, lobe.root_view, lobe.view_cosine * root), F(1e-12f));
    const F peak = half2 * (inverse * inverse) * squared;
    // One division for two quotients.
    const F sharpness = stretched * stretched * masking;
    const F fourth = squared * squared;
    const F quotient = F(1) / (sharpness * fourth);
    const F ratio = lobe.constant * (peak * peak) * (quotient * fourth);
    const F fresnel_weight = schlick_weight(simd::min(F(0.5f) * simd::sqrt(half2), F(1)));
    const F weight = share * (quotient * sharpness);
    const F weighted = weight * ratio;
    const F colored = simd::fma(F(1) - lobe.f0, fresnel_weight, lobe.f0) * ratio;
    sums.weight = sums.weight + weight;
    sums.plain = sums.plain + weighted;
    sums.fresnel = simd::fma(weighted, fresnel_weight, sums.fresnel);
    sums.square = simd::fma(weight * colored, colored, sums.square);
}

template <class F>
LobeRatio<F> means(const RatioSums<F>& sums) {
    const F inverse = F(1) / simd::max(sums.weight, F(1e-30f));
    return {sums.plain * inverse, sums.fresnel * inverse};
}

template <class F>
F with_fresnel(const CosineSpaceLobe<F>& lobe, const LobeRatio<F>& ratio) {
    return simd::fma(lobe.f0, ratio.plain - ratio.fresnel, ratio.fresnel);
}

// The standard deviation of lobe / D, with Fresnel, over the points.
template <class F>
F deviation(const CosineSpaceLobe<F>& lobe, const RatioSums<F>& sums, const LobeRatio<F>& ratio) {
    const F mean = with_fresnel(lobe, ratio);
    const F mean_square = sums.square / simd::max(sums.weight, F(1e-30f));
    return simd::sqrt(simd::max(mean_square - mean * mean, F(0)));
}

}  // namespace detail
}  // namespace penumbra
