#pragma once

#include "core/math/vec.h"

namespace penumbra {

// An orthonormal basis; `normal` is its z axis.
template <class F>
struct Frame {
    Vec3<F> tangent, bitangent, normal;

    [[nodiscard]] Vec3<F> to_local(const Vec3<F>& v) const {
        return {dot(v, tangent), dot(v, bitangent), dot(v, normal)};
    }
    [[nodiscard]] Vec3<F> to_world(const Vec3<F>& v) const {
        return fma(tangent, v.x, fma(bitangent, v.y, normal * v.z));
    }
};

// A basis around a unit vector without branches. Duff et al., "Building an Orthonormal Basis,
// Revisited" (2017): the sign keeps 1 + z away from zero.
template <class F>
Frame<F> frame_from_normal(const Vec3<F>& n) {
    const F sign = simd::copysign(F(1), n.z);
    const F a = F(-1) / (sign + n.z);
    const F b = n.x * n.y * a;
    return {{simd::fma(sign * n.x * n.x, a, F(1)), sign * b, -(sign * n.x)},
            {b, simd::fma(n.y * n.y, a, sign), -n.y},
            n};
}

// The basis in which linearly transformed cosines are tabulated: the view direction lies in the
// plane of tangent and normal, on the tangent's side. Any tangent where view and normal coincide.
template <class F>
Frame<F> frame_from_normal_and_view(const Vec3<F>& n, const Vec3<F>& view) {
    const Vec3<F> in_plane = view - n * dot(view, n);
    const F squared = length_squared(in_plane);
    const Frame<F> fallback = frame_from_normal(n);
    const auto degenerate = squared < F(1e-10f);
    const F safe = simd::select(degenerate, F(1), squared);
    const Vec3<F> tangent =
        select(degenerate, fallback.tangent, in_plane * (F(1) / simd::sqrt(safe)));
    return {tangent, cross(n, tangent), n};
}

}  // namespace penumbra
