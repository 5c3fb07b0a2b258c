#pragma once

#include "core/math/elementary.h"
#include "tests/lanes_agree.h"

// Every elementary function once.

namespace penumbra::tests {

inline constexpr int kElementaryResults = 13;

template <class F>
void emit_elementary_functions(F a, F b, Emit<F> emit) {
    F sine, cosine;
    sincos(a, sine, cosine);
    emit.number(sine);
    emit.number(cosine);
    sincos_two_pi(a, sine, cosine);
    emit.number(sine);
    emit.number(cosine);
    emit.number(acos(a));
    emit.number(acos(b * F(0.125f)));
    emit.number(atan(a));
    emit.number(atan2(a, b));
    emit.number(exp2(a));
    emit.number(exp(a));
    emit.number(log2(a));
    emit.number(log(a));
    emit.number(pow(a, b));
}

}  // namespace penumbra::tests

// Elements in [0, count), a multiple of 16; `out` holds kElementaryResults * count results.
namespace penumbra::avx2 {
void elementary_lanes(const float* a, const float* b, std::uint32_t* out, int count);
}
namespace penumbra::avx512 {
void elementary_lanes(const float* a, const float* b, std::uint32_t* out, int count);
}
