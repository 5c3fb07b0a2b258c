#pragma once

#include <cstdint>

#include "core/math/triangle.h"

// Cutouts: triangles with holes where an opacity map says so. Rasterizer and shadow rays must agree
// on every hole, so both ask is_opaque(), with barycentrics of ours and not of the ray tracer.

namespace penumbra {

// Level 0 of an opacity map, as Texture stores it.
struct CutoutMap {
    const std::int32_t* texels =
        nullptr;  // two words a texel; alpha is the upper half of the second
    std::int32_t width = 0, height = 0;
};

// A coordinate that repeats, in texels of a row of `size`, between the centres of two of them.
template <class F>
struct TexelPair {
    simd::IntOf<F> first, second;  // in [0, size), whatever the coordinate
    F fraction;                    // in [0, 1] from first to second
};

template <class F>
TexelPair<F> texel_pair(F coordinate, simd::IntOf<F> size) {
    using I = simd::IntOf<F>;
    const F repeated = coordinate - simd::floor(coordinate);
    const F position = simd::fma(repeated, simd::to_float(size), F(-0.5f));
    const F below = simd::floor(position);
    const I first = simd::to_int(below);
    const I second = first + I(1);
    // Not finite coordinates convert to the lowest integer: the last texel.
    return {simd::select(first < I(0), size - I(1), first),
            simd::select((second >= size) | (second < I(0)), I(0), second),
            simd::saturate(position - below)};
}

// Alpha in [0, 65535], bilinear; u to the right, v up.
template <class F>
F cutout_alpha(const CutoutMap& map, F u, F v) {
    using I = simd::IntOf<F>;
    using U = simd::UintOf<F>;
    const TexelPair<F> x = texel_pair(u, I(map.width));
    const TexelPair<F> y = texel_pair(F(1) - v, I(map.height));
    const auto alpha = [&](I column, I row) {
        const I word = simd::gather(map.texels + 1, (row * I(map.width) + column) * I(2));
        return simd::to_float(I(U(word) >> 16));
    };
    const F upper = simd::lerp(alpha(x.first, y.first), alpha(x.second, y.first), x.fraction);
    const F lower = simd::lerp(alpha(x.first, y.second), alpha(x.second, y.second), x.fraction);
    return simd::lerp(upper, lower, y.fraction);
}

// Is there a surface where the line from the triangle's origin along `direction` meets it? `uv` are
// the vertices' texture coordinates.
template <class F>
simd::MaskOf<F> is_opaque(const CutoutMap& map, const RelativeTriangle<F>& triangle,
                          const Vec2<F> (&uv)[3], const Vec3<F>& direction) {
    const Barycentrics<F> b = clamped_barycentrics(plane_equations(triangle), direction);
    const F u = simd::fma(b.b1, uv[1].x - uv[0].x, simd::fma(b.b2, uv[2].x - uv[0].x, uv[0].x));
    const F v = simd::fma(b.b1, uv[1].y - uv[0].y, simd::fma(b.b2, uv[2].y - uv[0].y, uv[0].y));
    return cutout_alpha(map, u, v) >= F(0.5f * 65535.0f);
}

}  // namespace penumbra
