#include "core/compare/ssim.h"

#include <array>

#include "core/compare/ssim_kernel.h"
#include "core/simd/isa.h"

namespace penumbra::compare {

void ssim_map(const Plane<float>& reference, const Plane<float>& test, const Extent& extent,
              Plane<float>& similarity) {
    static const Filter window = gaussian(1.5, kSsimRadius);
    const auto products =
        simd::pick(simd::best_isa(), &avx2::ssim_products_row, &avx512::ssim_products_row);
    const auto index = simd::pick(simd::best_isa(), &avx2::ssim_row, &avx512::ssim_row);
    std::array<Plane<float>, 5> moments;
    for (Plane<float>& plane : moments) plane = make_region(extent);
    for (int y = 0; y < extent.padded_height(); ++y) {
        float* const to[5] = {moments[0].row(y), moments[1].row(y), moments[2].row(y),
                              moments[3].row(y), moments[4].row(y)};
        products(reference.row(y), test.row(y), to, extent.padded_width());
    }
    Plane<float> rows = make_region(extent);
    for (Plane<float>& plane : moments) {
        filter_rows(plane, window, extent, rows);
        filter_columns(rows, window, extent, plane);
    }
    for (int y = 0; y < extent.height; ++y)
        index({moments[0].row(y), moments[1].row(y), moments[2].row(y), moments[3].row(y),
               moments[4].row(y)},
              similarity.row(y), extent.width);
}

}  // namespace penumbra::compare
