#pragma once

#include "core/bsdf/ggx.h"
#include "core/light/cosine_polygon.h"
#include "core/light/lobe_accuracy.h"
#include "core/light/ltc_table.h"

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
// inside and moves smoothly when the horizon cuts vertices off. Four levels: that direction alone;
// the middles of the triangles; of their quarters; six points on each quarter. The next level is
// asked where the polygon's size, and then the spread of lobe / D over the points at hand, say that
// it could change the pixel visibly, and blended in, so that no step is seen. The direction alone
// is already closer to the truth than fits of the lobe are. tests/core/lobe_ratio_test.cpp and
// docs/methods.md have the errors.

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
    const F miss = F(1) - simd::min(F(0.5f) * simd::sqrt(half2), F(1));
    const F miss2 = miss * miss;
    const F fresnel_weight = miss2 * miss2 * miss;
    const F weight = share * (quotient * sharpness);
    const F weighted = weight * ratio;
    const F colored = simd::fma(F(1) - lobe.f0, fresnel_weight, lobe.f0) * ratio;
    sums.weight = sums.weight + weight;
    sums.plain = sums.plain + weighted;
    sums.fresnel = simd::fma(weighted, fresnel_weight, sums.fresnel);
    sums.square = simd::fma(weight * colored, colored, sums.square);
}

// Exactly 0 where two vertices are the same, positive otherwise, however small the light.
template <class F>
F triangle_area(const Vec3<F>& a, const Vec3<F>& b, const Vec3<F>& c, const F& winding) {
    const Vec3<F> edge = c - b;
    return simd::select(length_squared(edge) > F(0),
                        simd::max(winding * dot(a, cross(b, edge)), F(1e-18f)), F(0));
}

template <class F>
Vec3<F> middle(const Vec3<F>& a, const Vec3<F>& b) {
    const Vec3<F> sum = a + b;
    return sum * inverse_length(sum);
}

// A triangle of unit vectors as one point: its mean by height, which is where a function that is
// linear in it has its mean under the clamped cosine.
template <class F>
struct TrianglePoint {
    Vec3<F> place;
    F share;  // area times height
};

template <class F>
TrianglePoint<F> triangle_point(const Vec3<F>& a, const Vec3<F>& b, const Vec3<F>& c,
                                const F& area) {
    const F height = a.z + b.z + c.z;
    const F inverse = F(0.25f) / simd::max(height, F(1e-18f));
    return {fma(a, simd::fma(a.z, inverse, F(0.25f)),
                fma(b, simd::fma(b.z, inverse, F(0.25f)), c * simd::fma(c.z, inverse, F(0.25f)))),
            area * height};
}

// Calls visit(point) with the triangles between the polygon's inner direction and its edges.
template <class F, class Visit>
void for_each_triangle(const CosinePolygon<F>& polygon, const Visit& visit) {
    const Vec3<F>& center = polygon.inside;
    for (int i = 0; i < polygon.count; ++i) {
        const Vec3<F>& a = polygon.vertices[i];
        const Vec3<F>& b = polygon.vertices[i + 1 < polygon.count ? i + 1 : 0];
        visit(triangle_point(center, a, b, triangle_area(center, a, b, polygon.winding)));
    }
}

template <class F>
RatioSums<F> sum_middles(const CosineSpaceLobe<F>& lobe, const CosinePolygon<F>& polygon) {
    RatioSums<F> sums;
    for_each_triangle(polygon, [&](const TrianglePoint<F>& point) {
        add_point(lobe, point.place, point.share, sums);
    });
    return sums;
}

// Calls visit(a, b, c, area) with the quarters of the triangles between center and edges.
template <class F, class Visit>
void for_each_quarter(const CosinePolygon<F>& polygon, const Visit& visit) {
    const Vec3<F>& center = polygon.inside;
    const F& winding = polygon.winding;
    const Vec3<F> first = middle(center, polygon.vertices[0]);
    Vec3<F> from = first;
    for (int i = 0; i < polygon.count; ++i) {
        const bool closes = i + 1 == polygon.count;
        const Vec3<F>& a = polygon.vertices[i];
        const Vec3<F>& b = polygon.vertices[closes ? 0 : i + 1];
        const Vec3<F> to = closes ? first : middle(center, b);
        const Vec3<F> edge = middle(a, b);
        const auto is_edge = length_squared(b - a) > F(0);
        const auto quarter = [&](const Vec3<F>& p, const Vec3<F>& q, const Vec3<F>& r) {
            visit(p, q, r, simd::select(is_edge, triangle_area(p, q, r, winding), F(0)));
        };
        quarter(center, from, to);
        quarter(a, edge, from);
        quarter(b, to, edge);
        quarter(from, edge, to);
        from = to;
    }
}

template <class F>
RatioSums<F> sum_quarters(const CosineSpaceLobe<F>& lobe, const CosinePolygon<F>& polygon) {
    RatioSums<F> sums;
    for_each_quarter(polygon,
                     [&](const Vec3<F>& a, const Vec3<F>& b, const Vec3<F>& c, const F& area) {
                         const TrianglePoint<F> point = triangle_point(a, b, c, area);
                         add_point(lobe, point.place, point.share, sums);
                     });
    return sums;
}

// Six points on each quarter: Dunavant's rule of degree 4 (see core/light/cut_polygon.h).
template <class F>
RatioSums<F> sum_finely(const CosineSpaceLobe<F>& lobe, const CosinePolygon<F>& polygon) {
    constexpr float kPlace[2] = {0.445948490915965f, 0.091576213509771f};
    constexpr float kWeight[2] = {0.223381589678011f, 0.109951743655322f};
    RatioSums<F> sums;
    for_each_quarter(polygon,
                     [&](const Vec3<F>& a, const Vec3<F>& b, const Vec3<F>& c, const F& area) {
                         for (int ring = 0; ring < 2; ++ring) {
                             const Vec3<F> all = (a + b + c) * F(kPlace[ring]);
                             const F more = F(1 - 3 * kPlace[ring]);
                             const F share = area * F(kWeight[ring]);
                             for (const Vec3<F>& corner : {a, b, c}) {
                                 const Vec3<F> place = fma(corner, more, all);
                                 add_point(lobe, place, share * place.z, sums);
                             }
                         }
                     });
    return sums;
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

// The share of all that the light makes of a pixel up to which glossy light may be wrong.
inline constexpr float kVisible = 0.01f;

// How far the next level is asked for, 0 to 1, where the glossy light of the sums at hand may be
// wrong by `doubt` times what it would be if lobe / D were 1.
template <class F>
F need_for_more(const CosineSpaceLobe<F>& lobe, const LobeRatio<F>& ratio,
                const RatioDemand<F>& demand, const F& doubt) {
    const F mean = with_fresnel(lobe, ratio);
    const F visible = F(kVisible) * simd::fma(demand.fitted, mean, demand.matte);
    const F excess = doubt * demand.fitted / simd::max(visible, F(1e-30f));
    return simd::select(demand.lit, simd::saturate(simd::fma(F(2), excess, F(-1))), F(0));
}

// The standard deviation of lobe / D, with Fresnel, over the points.
template <class F>
F deviation(const CosineSpaceLobe<F>& lobe, const RatioSums<F>& sums, const LobeRatio<F>& ratio) {
    const F mean = with_fresnel(lobe, ratio);
    const F mean_square = sums.square / simd::max(sums.weight, F(1e-30f));
    return simd::sqrt(simd::max(mean_square - mean * mean, F(0)));
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
    const LobeRatio<F> finer = extrapolate(coarse, means(quarters));
    const F change = simd::abs(with_fresnel(lobe, finer) - with_fresnel(lobe, coarse));
    const F spread = caution * deviation(lobe, quarters, means(quarters));
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
    if (demand.accuracy == LobeAccuracy::kFast) return center;
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
