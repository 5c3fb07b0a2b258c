#include "core/compare/ssim_kernel.h"

#include "core/compare/ssim_formula.h"
#include "core/simd/kernel.h"

namespace penumbra::PENUMBRA_ISA {

void ssim_products_row(const float* a, const float* b, float* const to[5], int count) {
    for (int x = 0; x < count; x += kLanes) {
        const F u = simd::load<F>(a + x) - F(compare::kSsimOrigin);
        const F v = simd::load<F>(b + x) - F(compare::kSsimOrigin);
        simd::store(to[0] + x, u);
        simd::store(to[1] + x, v);
        simd::store(to[2] + x, u * u);
        simd::store(to[3] + x, v * v);
        simd::store(to[4] + x, u * v);
    }
}

void ssim_row(const compare::SsimMoments& moments, float* similarity, int count) {
    for (int x = 0; x < count; x += kLanes) {
        const F a = simd::load<F>(moments.a + x), b = simd::load<F>(moments.b + x);
        const F variance_a = simd::load<F>(moments.aa + x) - a * a;
        const F variance_b = simd::load<F>(moments.bb + x) - b * b;
        const F covariance = simd::load<F>(moments.ab + x) - a * b;
        const F origin(compare::kSsimOrigin);
        simd::store(similarity + x, compare::ssim_index(a + origin, b + origin, variance_a,
                                                        variance_b, covariance));
    }
}

}  // namespace penumbra::PENUMBRA_ISA
