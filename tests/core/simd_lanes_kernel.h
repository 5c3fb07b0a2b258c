#pragma once

#include "tests/lanes_agree.h"

// Every operation of core/simd/lanes.h once.

namespace penumbra::tests {

inline constexpr int kLaneResults = 43;

template <class F>
void emit_arithmetic(F a, F b, F c, Emit<F>& emit) {
    emit.number(a + b);
    emit.number(a - b);
    emit.number(a * b);
    emit.number(a / b);
    emit.number(-a);
    emit.number(simd::fma(a, b, c));
    emit.number(simd::min(a, b));
    emit.number(simd::max(a, b));
    emit.number(simd::abs(a));
    emit.number(simd::sqrt(a));
    emit.number(simd::floor(a));
    emit.number(simd::round(a));
    emit.number(simd::copysign(a, b));
    emit.number(simd::clamp(a, b, c));
    emit.number(simd::saturate(a));
    emit.number(simd::lerp(a, b, c));
    emit.number(simd::select(a < b, a, c));
}

template <class F>
void emit_comparisons(F a, F b, Emit<F>& emit) {
    emit.mask(a == b);
    emit.mask(a != b);
    emit.mask(a < b);
    emit.mask(a <= b);
    emit.mask(a > b);
    emit.mask(a >= b);
    emit.mask((a < b) | (a == F(1)));
    emit.mask((a < b) & (b > F(0)));
    emit.mask((a < b) ^ (b > F(0)));
    emit.mask(!(a < b));
}

template <class F>
void emit_integers(F a, F b, Emit<F>& emit) {
    using I = simd::IntOf<F>;
    using U = simd::UintOf<F>;
    const U p = simd::as_uint(a);
    const U q = simd::as_uint(b);
    const I i = simd::as_int(a);
    const I j = simd::as_int(b);
    emit.integer(p + q);
    emit.integer(p - q);
    emit.integer(p * q);
    emit.integer(p & q);
    emit.integer(p | q);
    emit.integer(p ^ q);
    emit.integer(p << 5);
    emit.integer(p >> 7);
    emit.integer(U(i >> 7));
    emit.integer(simd::min(p, q));
    emit.integer(U(simd::max(i, j)));
    emit.mask(i < j);
    emit.mask(p <= q);
    emit.integer(simd::select(i == j, p, q));
    emit.integer(U(simd::to_int(a)));
    emit.number(simd::to_float(i));
}

template <class F>
void emit_lane_operations(F a, F b, F c, Emit<F> emit) {
    emit_arithmetic(a, b, c, emit);
    emit_comparisons(a, b, emit);
    emit_integers(a, b, emit);
}

}  // namespace penumbra::tests

// Elements in [0, count), a multiple of 16; `out` holds kLaneResults * count results.
namespace penumbra::avx2 {
void simd_lanes(const float* a, const float* b, const float* c, std::uint32_t* out, int count);
}
namespace penumbra::avx512 {
void simd_lanes(const float* a, const float* b, const float* c, std::uint32_t* out, int count);
}
