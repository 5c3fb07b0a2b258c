#pragma once

#include "core/compare/separable.h"
#include "core/image/plane.h"

// Structural similarity. Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From Error
// Visibility to Structural Similarity", IEEE Trans. Image Processing 13(4), 2004.

namespace penumbra::compare {

// The window reaches 5 pixels: 11 x 11, Gaussian, sigma = 1.5.
inline constexpr int kSsimRadius = 5;

// The index of one channel around each pixel of a region (equation 13, K1 = 0.01, K2 = 0.03, peak
// 1). Planes as in flip_map(), extent.halo >= kSsimRadius; `similarity` holds the region alone. The
// paper's mean runs over the windows that lie in the picture whole: see is_whole_window().
void ssim_map(const Plane<float>& reference, const Plane<float>& test, const Extent& extent,
              Plane<float>& similarity);

// Does the window around position `at` of `length` fit? Along a side shorter than a window the
// picture's edge is repeated, and every position counts.
[[nodiscard]] constexpr bool is_whole_window(int at, int length) {
    if (length <= 2 * kSsimRadius) return true;
    return at >= kSsimRadius && at < length - kSsimRadius;
}

}  // namespace penumbra::compare
