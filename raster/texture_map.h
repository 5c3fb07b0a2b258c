#pragma once

#include <cstdint>

#include "core/math/elementary.h"
#include "core/scene/cutout.h"

// Trilinear texture lookups in lanes, for textures as core/scene/texture.h stores them.

namespace penumbra::raster {

struct TextureMap {
    const std::int32_t* texels = nullptr;  // null: there is no texture
    const std::int32_t* levels = nullptr;  // width, height, offset of each level
    std::int32_t level_count = 0;

    [[nodiscard]] explicit operator bool() const { return texels != nullptr; }
};

// Where a pixel lies on a texture, and how its texture coordinates change to the next pixel.
template <class F>
struct TextureFootprint {
    Vec2<F> uv;
    Vec2<F> per_x, per_y;  // derivatives of uv by the pixel position
};

// The mip level whose texels are as large as the pixel's longer axis, in [0, level_count - 1]:
// log2 of the footprint in texels. Heckbert, "Survey of Texture Mapping" (1986), section 4.2.
template <class F>
F mip_level(const TextureMap& map, const TextureFootprint<F>& footprint) {
    const F width(static_cast<float>(map.levels[0]));
    const F height(static_cast<float>(map.levels[1]));
    const auto texels_squared = [&](const Vec2<F>& d) {
        const F x = d.x * width;
        const F y = d.y * height;
        return simd::fma(x, x, y * y);
    };
    const F longer = simd::max(texels_squared(footprint.per_x), texels_squared(footprint.per_y));
    return simd::clamp(F(0.5f) * penumbra::log2(longer), F(0),
                       F(static_cast<float>(map.level_count - 1)));
}

// A texel's channels in [0, 65535]: what a lookup returns is what it reads.
template <class F>
void read_texel(const TextureMap& map, simd::IntOf<F> at, Vec3<F>& rgb) {
    using I = simd::IntOf<F>;
    using U = simd::UintOf<F>;
    const I red_green = simd::gather(map.texels, at);
    const I blue_alpha = simd::gather(map.texels + 1, at);
    rgb = {simd::to_float(red_green & I(0xFFFF)), simd::to_float(I(U(red_green) >> 16)),
           simd::to_float(blue_alpha & I(0xFFFF))};
}
template <class F>
void read_texel(const TextureMap& map, simd::IntOf<F> at, F& red) {
    red = simd::to_float(simd::gather(map.texels, at) & simd::IntOf<F>(0xFFFF));
}
template <class F>
Vec3<F> mix(const Vec3<F>& a, const Vec3<F>& b, F t) {
    return fma(b - a, t, a);
}
template <class F>
F mix(const F& a, const F& b, F t) {
    return simd::lerp(a, b, t);
}

// One level, bilinear, in [0, 65535]. Value is Vec3<F> for red, green and blue, F for red alone.
template <class Value, class F>
Value sample_level(const TextureMap& map, const Vec2<F>& uv, simd::IntOf<F> level) {
    using I = simd::IntOf<F>;
    const I entry = level * I(3);
    const I width = simd::gather(map.levels, entry);
    const I height = simd::gather(map.levels + 1, entry);
    const I offset = simd::gather(map.levels + 2, entry);
    const TexelPair<F> x = texel_pair(uv.x, width);
    const TexelPair<F> y = texel_pair(F(1) - uv.y, height);
    const auto texel = [&](I column, I row) {
        Value value;
        read_texel<F>(map, offset + (row * width + column) * I(2), value);
        return value;
    };
    const Value upper = mix(texel(x.first, y.first), texel(x.second, y.first), x.fraction);
    const Value lower = mix(texel(x.first, y.second), texel(x.second, y.second), x.fraction);
    return mix(upper, lower, y.fraction);
}

template <class Value, class F>
Value sample_as(const TextureMap& map, const TextureFootprint<F>& footprint) {
    using I = simd::IntOf<F>;
    const F level = mip_level(map, footprint);
    const F whole = simd::floor(level);
    const F fraction = level - whole;
    const I first = simd::to_int(whole);
    const F scale(1.0f / 65535.0f);
    const Value fine = sample_level<Value>(map, footprint.uv, first);
    // Where no lane lies between levels the second one has weight 0: the same value without it.
    if (simd::none(fraction > F(0))) return fine * scale;
    const I second = simd::min(first + I(1), I(map.level_count - 1));
    return mix(fine, sample_level<Value>(map, footprint.uv, second), fraction) * scale;
}

// Red, green and blue in [0, 1], trilinear.
template <class F>
Vec3<F> sample(const TextureMap& map, const TextureFootprint<F>& footprint) {
    return sample_as<Vec3<F>>(map, footprint);
}
// The first channel in [0, 1], trilinear.
template <class F>
F sample_red(const TextureMap& map, const TextureFootprint<F>& footprint) {
    return sample_as<F>(map, footprint);
}

}  // namespace penumbra::raster
