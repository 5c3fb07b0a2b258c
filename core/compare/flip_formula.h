#pragma once

#include "core/math/elementary.h"
#include "core/math/vec.h"

// The pixel-wise formulas of FLIP over the lane type F. Andersson, Nilsson, Akenine-Moller,
// Oskarsson, Astrom, Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM
// Comput. Graph. Interact. Tech. 3(2), 2020 (sections in the comments); Andersson, Nilsson,
// Shirley, Akenine-Moller, "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics
// short papers, 2021.

namespace penumbra::compare {

// XYZ of white, with the matrix below.
inline constexpr float kWhiteX = 0.950428545f, kWhiteZ = 1.088900371f;

template <class F>
Vec3<F> xyz_from_linear(const Vec3<F>& c) {
    const auto row = [&](float r, float g, float b) {
        return simd::fma(F(r), c.x, simd::fma(F(g), c.y, F(b) * c.z));
    };
    return {row(0.41238656f, 0.35759150f, 0.18045049f), row(0.21263682f, 0.71518298f, 0.07218020f),
            row(0.01933062f, 0.11919717f, 0.95037259f)};
}

template <class F>
Vec3<F> linear_from_xyz(const Vec3<F>& c) {
    const auto row = [&](float x, float y, float z) {
        return simd::fma(F(x), c.x, simd::fma(F(y), c.y, F(z) * c.z));
    };
    return {row(3.24100326f, -1.53739899f, -0.49861587f),
            row(-0.96922427f, 1.87592999f, 0.04155422f),
            row(0.05563942f, -0.20401120f, 1.05714897f)};
}

// Section 3.1: the opponent space that the contrast sensitivity functions filter; linear in XYZ.
template <class F>
Vec3<F> ycxcz_from_linear(const Vec3<F>& rgb) {
    const Vec3<F> c = xyz_from_linear(rgb);
    const F x = c.x * F(1 / kWhiteX), y = c.y, z = c.z * F(1 / kWhiteZ);
    return {simd::fma(F(116), y, F(-16)), F(500) * (x - y), F(200) * (y - z)};
}

template <class F>
Vec3<F> linear_from_ycxcz(const Vec3<F>& c) {
    const F y = (c.x + F(16)) * F(1.0f / 116);
    const F x = simd::fma(F(1.0f / 500), c.y, y);
    const F z = simd::fma(F(-1.0f / 200), c.z, y);
    return linear_from_xyz(Vec3<F>{x * F(kWhiteX), y, z * F(kWhiteZ)});
}

// CIE 1976: the cube root with its linear foot.
template <class F>
F lab_curve(F t) {
    constexpr float kDelta = 6.0f / 29;
    const F root = pow(simd::max(t, F(1e-6f)), F(1.0f / 3));
    const F foot = simd::fma(F(1 / (3 * kDelta * kDelta)), t, F(4.0f / 29));
    return simd::select(t > F(kDelta * kDelta * kDelta), root, foot);
}

// L*a*b* with chroma scaled by lightness (Hunt effect), section 3.1.
template <class F>
Vec3<F> hunt_lab_from_linear(const Vec3<F>& rgb) {
    const Vec3<F> c = xyz_from_linear(rgb);
    const F x = lab_curve(c.x * F(1 / kWhiteX));
    const F y = lab_curve(c.y);
    const F z = lab_curve(c.z * F(1 / kWhiteZ));
    const F lightness = simd::fma(F(116), y, F(-16));
    const F hunt = F(0.01f) * lightness;
    return {lightness, hunt * (F(500) * (x - y)), hunt * (F(200) * (y - z))};
}

// The HyAB distance of Abasi et al. (2020) raised to q_c = 0.7, section 3.1.
template <class F>
F colour_distance(const Vec3<F>& a, const Vec3<F>& b) {
    const Vec3<F> d = a - b;
    const F distance = simd::abs(d.x) + simd::sqrt(simd::fma(d.y, d.y, d.z * d.z));
    return pow(distance, F(0.7f));
}

// Section 3.1: distances up to p_c = 0.4 of the largest (green to blue) take [0, p_t = 0.95], the
// rest is compressed into what is left.
template <class F>
F redistribute(F distance, float largest) {
    const float knee = 0.4f * largest;
    const F above = simd::fma(distance - F(knee), F(0.05f / (largest - knee)), F(0.95f));
    return simd::select(distance < F(knee), distance * F(0.95f / knee), above);
}

// Section 3.3: colour_error ^ (1 - feature_error), with the feature error of section 3.2 from the
// larger of the differences of edges and points, raised to q_f = 0.5.
template <class F>
F flip_error(F colour_error, F edge_difference, F point_difference) {
    const F difference = simd::max(simd::abs(edge_difference), simd::abs(point_difference));
    const F feature_error = simd::sqrt(difference * F(0.70710678f));
    return pow(colour_error, F(1) - feature_error);
}

// The ACES fit of Narkowicz (2016) with its exposure factor of 0.6, clamped to what a display
// shows; the tone curve of HDR-FLIP, 2021, section 3.
template <class F>
F display_from_scene(F x) {
    // Beyond this the quotient is 1 in float, and its terms must not overflow.
    const F v = simd::min(simd::max(x, F(0)), F(1e6f)) * F(0.6f);
    const F numerator = v * simd::fma(F(2.51f), v, F(0.03f));
    const F denominator = simd::fma(v, simd::fma(F(2.43f), v, F(0.59f)), F(0.14f));
    return simd::min(numerator / denominator, F(1));
}

}  // namespace penumbra::compare
