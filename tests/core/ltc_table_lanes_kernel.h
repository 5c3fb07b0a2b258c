#pragma once

#include "core/light/ltc_table.h"
#include "tests/lanes_agree.h"

// The lookup in the table of linearly transformed cosines, and GGX, once.

namespace penumbra::tests {

inline constexpr int kLtcLaneResults = 16;

template <class F>
void emit_lobe(F alpha, const Vec3<F>& view, const Vec2<F>& random, Emit<F>& emit) {
    const Vec3<F> direction = ggx_sample_direction(alpha, view, random);
    const GgxLobe<F> lobe = ggx_evaluate(alpha, view, direction);
    emit.number(direction.x);
    emit.number(direction.y);
    emit.number(direction.z);
    emit.number(lobe.brdf_times_cosine);
    emit.number(lobe.fresnel_weight);
    emit.number(lobe.density);
}

template <class F>
void emit_ltc_lookup(F roughness, F cos_view, Emit<F> emit) {
    const LtcEntry<F> entry = ltc_lookup(roughness, cos_view);
    emit.number(entry.m00);
    emit.number(entry.m02);
    emit.number(entry.m22);
    emit.number(entry.determinant());
    emit.number(entry.norm);
    emit.number(entry.fresnel);
    const F cosine = simd::saturate(cos_view);
    const Vec3<F> view = {simd::sqrt(F(1) - cosine * cosine), F(0), cosine};
    const Vec3<F> mirrored = {-view.x, F(0), cosine};
    emit.number(ltc_density(entry, mirrored));
    const Vec3<F> back = from_cosine_space(entry, to_cosine_space(entry, mirrored));
    emit.number(back.x);
    emit.number(back.y);
    emit.number(back.z);
    const F alpha = simd::square(simd::clamp(roughness, F(kMinimumRoughness), F(1)));
    emit_lobe(alpha, view, Vec2<F>{simd::saturate(F(0.999f) - cosine), cosine}, emit);
}

}  // namespace penumbra::tests

// Elements in [0, count), a multiple of 16; `out` holds kLtcLaneResults * count results.
namespace penumbra::avx2 {
void ltc_lanes(const float* a, const float* b, std::uint32_t* out, int count);
}
namespace penumbra::avx512 {
void ltc_lanes(const float* a, const float* b, std::uint32_t* out, int count);
}
