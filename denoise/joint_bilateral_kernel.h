#pragma once

#include <cstddef>

#include "denoise/joint_bilateral.h"
#include "denoise/joint_bilateral_formula.h"

namespace penumbra::denoise {

// The horizontal pass copies what a row's taps read to scratch, with a block of nothing at both
// ends: depth, normal, S_N and U_N, each in a row of its own.
inline constexpr int kRowPlanes = 10;
static_assert(kBlock >= kMaxFilterRadius);

constexpr std::size_t filter_row_stride(int window_width) {
    return static_cast<std::size_t>((window_width + kBlock - 1) / kBlock + 2) * kBlock;
}
constexpr std::size_t filter_scratch_size(int window_width) {
    return kRowPlanes * filter_row_stride(window_width);
}

struct RowFilter {
    const HorizontalFilterPass* pass;
    PixelRect existing;  // elements that are pixels of the frame
    float* scratch;
    Vec3f step;
};
struct ColumnFilter {
    const VerticalFilterPass* pass;
    PixelRect existing;
    Vec3f step;
};

}  // namespace penumbra::denoise

namespace penumbra::avx2 {
void filter_row(const denoise::RowFilter& filter, int y);
void filter_columns(const denoise::ColumnFilter& filter, const PixelRect& elements);
}  // namespace penumbra::avx2
namespace penumbra::avx512 {
void filter_row(const denoise::RowFilter& filter, int y);
void filter_columns(const denoise::ColumnFilter& filter, const PixelRect& elements);
}  // namespace penumbra::avx512
