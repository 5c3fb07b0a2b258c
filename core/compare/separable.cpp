#include "core/compare/separable.h"

#include <cmath>

#include "core/compare/convolve_kernel.h"
#include "core/simd/isa.h"

namespace penumbra::compare {
namespace {

auto convolve_function() {
    return simd::pick(simd::best_isa(), &avx2::convolve, &avx512::convolve);
}

}  // namespace

Filter gaussian(double sigma, int radius) {
    std::vector<double> values;
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) {
        values.push_back(std::exp(-x * x / (2 * sigma * sigma)));
        sum += values.back();
    }
    Filter filter;
    for (const double value : values) filter.weights.push_back(static_cast<float>(value / sum));
    return filter;
}

Plane<float> make_region(const Extent& extent) {
    return {extent.padded_width() + kRowPadding, extent.padded_height()};
}

void filter_rows(const Plane<float>& from, const Filter& filter, const Extent& extent,
                 Plane<float>& to) {
    const auto convolve = convolve_function();
    const int taps = static_cast<int>(filter.weights.size());
    for (int y = 0; y < extent.padded_height(); ++y)
        convolve(from.row(y) + extent.halo - filter.radius(), 1, filter.weights.data(), taps,
                 to.row(y), extent.width);
}

void filter_columns(const Plane<float>& from, const Filter& filter, const Extent& extent,
                    Plane<float>& to) {
    const auto convolve = convolve_function();
    const int taps = static_cast<int>(filter.weights.size());
    for (int y = 0; y < extent.height; ++y)
        convolve(from.row(y + extent.halo - filter.radius()), from.stride(), filter.weights.data(),
                 taps, to.row(y), extent.width);
}

}  // namespace penumbra::compare
