#pragma once

namespace penumbra::compare {

// Rows of local means: of a, of b, of a a, of b b, of a b.
struct SsimMoments {
    const float* a;
    const float* b;
    const float* aa;
    const float* bb;
    const float* ab;
};

// Values are moved by this before their moments are taken: variances do not change, and less is
// lost to cancellation.
inline constexpr float kSsimOrigin = 0.5f;

}  // namespace penumbra::compare

// Counts are rounded up to whole vectors.
namespace penumbra::avx2 {
void ssim_products_row(const float* a, const float* b, float* const to[5], int count);
void ssim_row(const compare::SsimMoments& moments, float* similarity, int count);
}  // namespace penumbra::avx2

namespace penumbra::avx512 {
void ssim_products_row(const float* a, const float* b, float* const to[5], int count);
void ssim_row(const compare::SsimMoments& moments, float* similarity, int count);
}  // namespace penumbra::avx512
