#pragma once

#include <cstddef>

// to[x] = sum over k of weights[k] * from[x + k * step], x in [0, width); width is rounded up to
// whole vectors. With step 1 a filter along a row, with a plane's stride one down its columns.

namespace penumbra::avx2 {
void convolve(const float* from, std::ptrdiff_t step, const float* weights, int taps, float* to,
              int width);
}
namespace penumbra::avx512 {
void convolve(const float* from, std::ptrdiff_t step, const float* weights, int taps, float* to,
              int width);
}
