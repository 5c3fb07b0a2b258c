#pragma once

// The sRGB curve over rows; counts are rounded up to whole vectors. Arguments are clamped to [0,
// 1].

namespace penumbra::avx2 {
void clamp_row(const float* from, float* to, int count);
void encode_srgb_row(const float* linear, float* coded, int count);
void decode_srgb_row(const float* coded, float* linear, int count);
}  // namespace penumbra::avx2

namespace penumbra::avx512 {
void clamp_row(const float* from, float* to, int count);
void encode_srgb_row(const float* linear, float* coded, int count);
void decode_srgb_row(const float* coded, float* linear, int count);
}  // namespace penumbra::avx512
