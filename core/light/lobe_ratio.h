#pragma once

#include "core/light/lobe_accuracy.h"
#include "core/light/lobe_points.h"

// The glossy light of a polygon, equal to the true BRDF's and without noise: the integral of the
// fitted distribution D over the light has a closed form; here it is multiplied with the mean of
// lobe / D over the light, weighted by D:
//
//     integral of lobe dw = (integral of D dw) * (integral of (lobe / D) D dw) / (integral of D dw)
//
// In the space where D is the clamped cosine, lobe / D is a smooth function whatever the roughness,
// and the light a polygon with straight edges: few fixed points on it give the mean. The points
// move with the polygon's vertices, so that what error remains is a smooth function of the place,
// without noise and without bands. Both integrals of the fraction are taken with the same points:
// where the fit is exact the fraction is, too.
//
// The polygon is cut into triangles around the direction of its vector irradiance, which lies
// inside and moves smoothly when the horizon cuts vertices off. Four levels: their common mean; one
// point for each; one for each of their quarters, the quadratic error extrapolated away; six for
// each quarter. The next level is asked where the polygon's size, and then the spread of lobe / D
// over the points at hand, say that it could change the pixel visibly, and blended in, so that no
// step is seen. The one point alone is already closer to the truth than fits of the lobe are.
// tests/core/lobe_ratio_test.cpp and docs/methods.md have the errors.

namespace penumbra {

// Integrals over the light: of the lobe, and of the lobe times Schlick's (1 - v.h)^5.
template <class F>
struct LobeIntegral {
    F plain, fresnel;
};

// What decides how fine the mean has to be.
template <class F>
struct RatioDemand {
    simd::MaskOf<F> lit;  // other lanes ask for nothing
    F fitted;             // the integral of D over the light
    F matte;              // what the diffuse lobe reflects of the light, per radiance
    LobeAccuracy accuracy;
};

namespace detail {

// The share of all that the light makes of a pixel up to which glossy light may be wrong.
constexpr float tolerance_of(LobeAccuracy accuracy) {
    return accuracy == LobeAccuracy::kFast ? 0.08f : 0.01f;
}

// How far the next level is asked for, 0 to 1, where the glossy light of the sums at hand may be
// wrong by `doubt` times what it would be if lobe / D were 1.
template <class F>
F need_for_more(const CosineSpaceLobe<F>& lobe, const LobeRatio<F>& ratio,
                const RatioDemand<F>& demand, const F& doubt) {
    const F mean = with_fresnel(lobe, ratio);
    const F visible =
        F(tolerance_of(demand.accuracy)) * simd::fma(demand.fitted, mean, demand.matte);
    const F excess = doubt * demand.fitted / simd::max(visible, F(1e-30f));
    return simd::select(demand.lit, simd::saturate(simd::fma(F(2), excess, F(-1))), F(0));
}

// At the polygon's mean by height.
template <class F>
LobeRatio<F> ratio_at_center(const CosineSpaceLobe<F>& lobe, const CosinePolygon<F>& polygon) {
    Vec3<F> center{F(0), F(0), F(0)};
    for_each_triangle(polygon, [&](const TrianglePoint<F>& point) {
        center = fma(point.place, point.share, center);
    });
    RatioSums<F> sums;
    add_point(lobe, center * inverse_length(center), F(1), sums);
    return means(sums);
}

template <class F>
LobeRatio<F> blend(const LobeRatio<F>& coarse, const LobeRatio<F>& fine, const F& share) {
    return {simd::lerp(coarse.plain, fine.plain, share),
            simd::lerp(coarse.fresnel, fine.fresnel, share)};
}

// 2 (1 - cosine) of the largest angle between the center and a vertex.
template <class F>
F squared_size(const CosinePolygon<F>& polygon) {
    F least = F(1);
    for (int i = 0; i < polygon.count; ++i)
        least = simd::min(dot(polygon.inside, polygon.vertices[i]), least);
    return F(2) * (F(1) - least);
}

// At grazing views masking makes the lobe steep towards the horizon, over heights of about n.v.
template <class F>
F grazing(const CosineSpaceLobe<F>& lobe) {
    const F cosine = simd::max(lobe.view_cosine, F(0.01f));
    return F(1) + F(0.15f) / (cosine * cosine);
}

// The error of one point per triangle falls with the square of their size: quarters leave a quarter
// of it, which the difference tells (Richardson).
template <class F>
LobeRatio<F> extrapolate(const LobeRatio<F>& coarse, const LobeRatio<F>& finer) {
    const F third = F(1.0f / 3);
    return {simd::max(simd::fma(finer.plain - coarse.plain, third, finer.plain), F(0)),
            simd::max(simd::fma(finer.fresnel - coarse.fresnel, third, finer.fresnel), F(0))};
}

// What may be left of a change by extrapolation.
inline constexpr float kFinestDoubt = 0.3f;
// And what the spread over the quarters says where both levels miss a narrow peak.
inline constexpr float kFinestSpread = 0.06f;

// The levels beyond the center, for the lanes with `share` > 0.
template <class F>
LobeRatio<F> mean_over_triangles(const CosineSpaceLobe<F>& lobe, const CosinePolygon<F>& polygon,
                                 const RatioDemand<F>& demand, const F& size, const F& share) {
    // Of large polygons few points tell less.
    const F caution = simd::fma(F(0.6f) * size, size, F(0.5f));
    const RatioSums<F> middles = sum_middles(lobe, polygon);
    const LobeRatio<F> coarse = means(middles);
    const F more = need_for_more(lobe, coarse, demand, caution * deviation(lobe, middles, coarse));
    if (simd::none((share > F(0)) & (more > F(0)))) return coarse;
    const RatioSums<F> quarters = sum_quarters(lobe, polygon);
    const LobeRatio<F> quartered = means(quarters);
    const LobeRatio<F> finer = extrapolate(coarse, quartered);
    const F change = simd::abs(with_fresnel(lobe, finer) - with_fresnel(lobe, coarse));
    const F spread = caution * deviation(lobe, quarters, quartered);
    const F most = need_for_more(lobe, finer, demand,
                                 simd::fma(F(kFinestSpread), spread, F(kFinestDoubt) * change));
    if (simd::none((share > F(0)) & (more > F(0)) & (most > F(0))))
        return blend(coarse, finer, more);
    const LobeRatio<F> finest = means(sum_finely(lobe, polygon));
    return blend(coarse, blend(finer, finest, most), more);
}

template <class F>
LobeRatio<F> mean_lobe_ratio(const CosineSpaceLobe<F>& lobe, const CosinePolygon<F>& polygon,
                             const RatioDemand<F>& demand) {
    const LobeRatio<F> center = ratio_at_center(lobe, polygon);
    const F size = squared_size(polygon);
    // The center may miss the lobe's peak: its mean over all directions is the albedo.
    const F mean =
        simd::max(with_fresnel(lobe, center), with_fresnel(lobe, {lobe.norm, lobe.fresnel}));
    const F share = need_for_more(lobe, center, demand, F(0.4f) * size * grazing(lobe) * mean);
    if (simd::none(share > F(0))) return center;
    return blend(center, mean_over_triangles(lobe, polygon, demand, size, share), share);
}

}  // namespace detail

// 0 where a lane is not lit. Never more than the lobe's albedo. Lights that hold nearly all of D
// hold nearly all of the lobe: there the albedo, which is known, takes the place of the mean.
template <class F>
LobeIntegral<F> integrate_lobe(const CosineSpaceLobe<F>& lobe, const CosinePolygon<F>& polygon,
                               const RatioDemand<F>& demand) {
    const F whole = simd::saturate(simd::fma(demand.fitted, F(40), F(-38.8f)));  // from 0.97
    RatioDemand<F> partial = demand;
    partial.lit = demand.lit & (whole < F(1));
    const detail::LobeRatio<F> ratio = detail::mean_lobe_ratio(lobe, polygon, partial);
    const F plain = simd::min(demand.fitted * ratio.plain, lobe.norm);
    const F fresnel = simd::min(demand.fitted * ratio.fresnel, lobe.fresnel);
    return {
        simd::select(demand.lit, simd::lerp(plain, demand.fitted * lobe.norm, whole), F(0)),
        simd::select(demand.lit, simd::lerp(fresnel, demand.fitted * lobe.fresnel, whole), F(0))};
}

}  // namespace penumbra
