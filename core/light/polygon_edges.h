#pragma once

#include "core/light/seen_polygon.h"
#include "core/math/elementary.h"

// What the integrals over a polygon are made of: the weights of its edges, and the integrand at a
// point of a light too small for them.

namespace penumbra::detail {

// theta / sin(theta) of cosines in [0, 1]: 1.2e-8 relative for the polynomial, a minimax fit of our
// own in 1 - cos; no arc cosine, hence no cancellation near 1.
template <class F>
F arc_over_sine(F cosine) {
    const F x = F(1) - cosine;
    if constexpr (std::is_same_v<F, double>) {
        const double sine = simd::sqrt(simd::max(x * (1 + cosine), 0.0));
        return x < 1e-4 ? 1 + x * (1.0 / 3 + x * (2.0 / 15 + x * (2.0 / 35)))
                        : atan2(sine, cosine) / sine;
    } else {
        F sum = F(0.011357376936579367f);
        for (const float coefficient :
             {-0.033457437314962486f, 0.05257877268953691f, -0.03515096183302246f,
              0.030985712751230268f, 0.019848678530043257f, 0.058037706546425386f,
              0.13326088350660623f, 0.3333355884198665f, 0.9999999885027411f})
            sum = simd::fma(sum, x, F(coefficient));
        return sum;
    }
}

template <class F>
F inverse_length(const Vec3<F>& v) {
    return F(1) / simd::sqrt(simd::max(length_squared(v), F(1e-36f)));
}

// Of the edges from a to b: pi - theta has the same sine as theta. That sine is what the edge's
// normal is divided by, so it comes from the cross product and not from the cosine.
template <class F>
F obtuse_arc_over_sine(F supplement, const Vec3<F>& a, const Vec3<F>& b, F inverse_lengths) {
    const F sine = simd::max(length(cross(a, b - a)) * inverse_lengths, F(1e-9f));
    return F(3.14159265358979323846) / sine - supplement;
}

// theta / |a x b| for the angle theta between each direction a and the next one, b.
template <class F>
void edge_weights(const Vec3<F>* directions, int count, F* weights) {
    F inverses[kMaxClippedVertices];  // first of each length, then of each pair's
    F cosines[kMaxClippedVertices];
    for (int i = 0; i < count; ++i) inverses[i] = inverse_length(directions[i]);
    const F first_inverse = inverses[0];
    F least = F(1);
    for (int i = 0; i < count; ++i) {
        const bool closes = i + 1 == count;
        inverses[i] = inverses[i] * (closes ? first_inverse : inverses[i + 1]);
        cosines[i] = dot(directions[i], directions[closes ? 0 : i + 1]) * inverses[i];
        weights[i] = arc_over_sine(simd::abs(cosines[i]));
        least = simd::min(cosines[i], least);
    }
    if (simd::any(least < F(0))) {
        for (int i = 0; i < count; ++i)
            weights[i] = simd::select(
                cosines[i] < F(0),
                obtuse_arc_over_sine(weights[i], directions[i],
                                     directions[i + 1 == count ? 0 : i + 1], inverses[i]),
                weights[i]);
    }
    for (int i = 0; i < count; ++i) weights[i] = weights[i] * inverses[i];
}

// Dunavant, "High Degree Efficient Symmetrical Gaussian Quadrature Rules for the Triangle" (1985):
// 6 points, degree 4, in two rings of three. A point lies at `place` of two corners.
inline constexpr double kDunavantPlace[2] = {0.445948490915965, 0.091576213509771};
inline constexpr double kDunavantWeight[2] = {0.223381589678011, 0.109951743655322};

// The integrand of a small light at one of its points, per area and distance from its plane.
template <class F, class Lobe>
F point_kernel(const Lobe& lobe, const Vec3<F>& direction) {
    const F squared = simd::max(length_squared(direction), F(1e-18f));
    return simd::max(lobe.height(direction), F(0)) / (squared * squared);
}

}  // namespace penumbra::detail
