#pragma once

#include "core/bsdf/ggx.h"
#include "core/light/ltc_rows.h"
#include "core/math/vec.h"

// Linearly transformed cosines for our GGX: Heitz, Dupuy, Hill and Neubelt, "Real-Time
// Polygonal-Light Shading with Linearly Transformed Cosines" (2016), with a table of our own
// (apps/tools/ltc_fit). Differs from theirs: the matrix keeps the horizon in its place, so that a
// light which was clipped to the horizon once is so for both lobes and no light is lost or leaks;
// the lower row is stored divided by alpha, and the angle axis resolves grazing views.
//
// The frame is that of frame_from_normal_and_view: z is the normal, the view is (sin, 0, cos).
//
// The table is where the integral over a light begins and not where it ends: the entry's
// distribution D is close to the lobe but not the lobe, and core/light/lobe_ratio.h multiplies its
// integral with the mean of lobe / D over the light.

namespace penumbra {

template <class F>
struct LtcEntry {
    // The inverse matrix is ((m00, 0, m02), (0, 1, 0), (0, 0, m22)), with m00, m22 > 0.
    F m00, m02, m22;
    // Albedos for the two terms of Schlick's Fresnel F0 + (1 - F0) (1 - V.H)^5: the integrals of
    // the BRDF times cosine, and of that times (1 - V.H)^5.
    F norm, fresnel;

    [[nodiscard]] F determinant() const { return m00 * m22; }
};

// Number of nodes along each axis of the table. Roughness is linear from kMinimumRoughness to 1.
inline constexpr int kLtcRoughnessNodes = 64;
inline constexpr int kLtcAngleNodes = 64;
// How much of the angle axis belongs to grazing views; see ltc_angle_coordinate.
inline constexpr float kLtcGrazingStretch = 1.5f;

// kLtcRoughnessNodes x kLtcAngleNodes rows of kLtcRowFloats floats, the angle running fastest:
// cos and sin of the tilt of the lobe's ridge, the stretch (m00, m02) = stretch * (cos, sin), m22 /
// alpha, norm, fresnel, and two zeros. In these terms the narrowest lobes at grazing views vary as
// slowly as wide ones, so that bilinear interpolation keeps their direction.
extern const float kLtcTable[];

// Position along the angle axis, 0 at normal incidence and 1 at grazing. Like the angle itself near
// the normal, but with nodes as fine as 0.1 degrees near grazing.
template <class F>
F ltc_angle_coordinate(const F& cos_view) {
    const F cosine = simd::saturate(cos_view);
    const F steep = simd::sqrt(F(1) - cosine);
    return steep / simd::fma(F(kLtcGrazingStretch), simd::sqrt(cosine), steep);
}

// Bilinear lookup. Roughness is clamped to [kMinimumRoughness, 1] and the cosine to [0, 1]; NaN
// counts as the lower bound, so lanes that hold nothing are harmless. The same bits for float and
// any lane count.
template <class F>
LtcEntry<F> ltc_lookup(const F& roughness, const F& cos_view, const float* table = kLtcTable);

// From the shading frame to the space where D is the clamped cosine over pi. Not normalised.
template <class F>
Vec3<F> to_cosine_space(const LtcEntry<F>& entry, const Vec3<F>& direction) {
    return {simd::fma(entry.m00, direction.x, entry.m02 * direction.z), direction.y,
            entry.m22 * direction.z};
}

// The way back, up to a positive factor.
template <class F>
Vec3<F> from_cosine_space(const LtcEntry<F>& entry, const Vec3<F>& direction) {
    return {simd::fma(entry.m22, direction.x, -(entry.m02 * direction.z)),
            entry.determinant() * direction.y, entry.m00 * direction.z};
}

// D of a unit direction, per steradian. It integrates to 1 over the hemisphere above the horizon.
template <class F>
F ltc_density(const LtcEntry<F>& entry, const Vec3<F>& direction) {
    const Vec3<F> q = to_cosine_space(entry, direction);
    const F squared = length_squared(q);
    return F(kOneOverPi) * simd::max(q.z, F(0)) * entry.determinant() / (squared * squared);
}

// The share of the light that a surface under uniform light of radiance 1 reflects specularly.
template <class F>
Vec3<F> ltc_specular_albedo(const LtcEntry<F>& entry, const Vec3<F>& f0) {
    const F slope = entry.norm - entry.fresnel;
    return {simd::fma(f0.x, slope, entry.fresnel), simd::fma(f0.y, slope, entry.fresnel),
            simd::fma(f0.z, slope, entry.fresnel)};
}

// ---- implementation --------------------------------------------------------------------------

template <class F>
LtcEntry<F> ltc_lookup(const F& roughness, const F& cos_view, const float* table) {
    const F clamped = simd::clamp(roughness, F(kMinimumRoughness), F(1));
    const F scale = F((kLtcRoughnessNodes - 1) / (1 - kMinimumRoughness));
    const LtcRow<F> row = ltc_interpolate_rows<kLtcRoughnessNodes, kLtcAngleNodes>(
        table, (clamped - F(kMinimumRoughness)) * scale,
        ltc_angle_coordinate(cos_view) * F(kLtcAngleNodes - 1));
    const F alpha = clamped * clamped;
    LtcEntry<F> entry{};
    entry.m00 = row.column[2] * row.column[0];
    entry.m02 = row.column[2] * row.column[1];
    entry.m22 = row.column[3] * alpha;
    entry.norm = row.column[4];
    entry.fresnel = row.column[5];
    return entry;
}

}  // namespace penumbra
