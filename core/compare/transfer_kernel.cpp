#include "core/compare/transfer_kernel.h"

#include "core/math/elementary.h"
#include "core/simd/kernel.h"

// IEC 61966-2-1, as in core/image/srgb.h.

namespace penumbra::PENUMBRA_ISA {
namespace {

F load_unit(const float* from) {
    return simd::min(simd::max(simd::load<F>(from), F(0)), F(1));
}

}  // namespace

void clamp_row(const float* from, float* to, int count) {
    for (int x = 0; x < count; x += kLanes) simd::store(to + x, load_unit(from + x));
}

void encode_srgb_row(const float* linear, float* coded, int count) {
    for (int x = 0; x < count; x += kLanes) {
        const F v = load_unit(linear + x);
        const F foot = F(12.92f) * v;
        const F curve = simd::fma(F(1.055f), pow(simd::max(v, F(1e-6f)), F(1 / 2.4f)), F(-0.055f));
        simd::store(coded + x, simd::select(v <= F(0.0031308f), foot, curve));
    }
}

void decode_srgb_row(const float* coded, float* linear, int count) {
    for (int x = 0; x < count; x += kLanes) {
        const F v = load_unit(coded + x);
        const F foot = v * F(1 / 12.92f);
        const F curve = pow((v + F(0.055f)) * F(1 / 1.055f), F(2.4f));
        simd::store(linear + x, simd::select(v <= F(0.04045f), foot, curve));
    }
}

}  // namespace penumbra::PENUMBRA_ISA
