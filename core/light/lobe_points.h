#pragma once

#include "core/light/cosine_polygon.h"
#include "core/light/cosine_space_lobe.h"

// The points of a polygon at which core/light/lobe_ratio.h asks for lobe / D, level by level. They
// move smoothly with the polygon's vertices.

namespace penumbra::detail {

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

// Dunavant's six points on each quarter.
template <class F>
RatioSums<F> sum_finely(const CosineSpaceLobe<F>& lobe, const CosinePolygon<F>& polygon) {
    RatioSums<F> sums;
    for_each_quarter(polygon,
                     [&](const Vec3<F>& a, const Vec3<F>& b, const Vec3<F>& c, const F& area) {
                         for (int ring = 0; ring < 2; ++ring) {
                             const auto place_of_ring = static_cast<float>(kDunavantPlace[ring]);
                             const Vec3<F> all = (a + b + c) * F(place_of_ring);
                             const F more = F(1 - 3 * place_of_ring);
                             const F share = area * F(static_cast<float>(kDunavantWeight[ring]));
                             for (const Vec3<F>& corner : {a, b, c}) {
                                 const Vec3<F> place = fma(corner, more, all);
                                 add_point(lobe, place, share * place.z, sums);
                             }
                         }
                     });
    return sums;
}

}  // namespace penumbra::detail
