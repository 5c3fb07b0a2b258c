#include "denoise/joint_bilateral.h"

#include "denoise/band.h"
#include "denoise/joint_bilateral_kernel.h"

namespace penumbra::denoise {
namespace {

// Strips of this many columns, over the rows that a column's taps reach, stay in the second-level
// cache.
constexpr int kStripWidth = 256;

void check(const FilterSettings& settings) {
    PENUMBRA_ASSERT(settings.radius >= 1 && settings.radius <= kMaxFilterRadius, "radius = {}",
                    settings.radius);
    PENUMBRA_ASSERT(settings.smallest_radius > 0, "smallest radius = {}", settings.smallest_radius);
    static_cast<void>(settings);
}

}  // namespace

void filter_horizontally(const HorizontalFilterPass& pass, int y0, int y1, Scratch& scratch) {
    check(pass.settings);
    PENUMBRA_ASSERT(scratch.size() >= filter_scratch_size(pass.frame.window.width()), "{} floats",
                    scratch.size());
    const Camera& camera = pass.guides.camera;
    const RowFilter filter{.pass = &pass,
                           .existing = existing_elements(pass.frame),
                           .scratch = scratch.data(),
                           .step = camera.right * (1 / camera.focal)};
    for (int y = y0 - pass.frame.window.y0; y < y1 - pass.frame.window.y0; ++y)
        simd::pick(pass.isa, &avx2::filter_row, &avx512::filter_row)(filter, y);
}

void filter_vertically(const VerticalFilterPass& pass, const PixelRect& band) {
    check(pass.settings);
    const Camera& camera = pass.guides.camera;
    const ColumnFilter filter{.pass = &pass,
                              .existing = existing_elements(pass.frame),
                              .step = camera.up * (-1 / camera.focal)};
    PixelRect strip = band_elements(pass.frame, band);
    for (const int end = strip.x1; strip.x0 < end; strip.x0 = strip.x1) {
        strip.x1 = std::min(strip.x0 + kStripWidth, end);
        simd::pick(pass.isa, &avx2::filter_columns, &avx512::filter_columns)(filter, strip);
    }
}

}  // namespace penumbra::denoise
