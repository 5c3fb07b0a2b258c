#include "core/image/half.h"

#include <algorithm>

#include "core/image/half_kernel.h"
#include "core/simd/isa.h"

namespace penumbra::image {
namespace {

// Kernels take whole vectors; the rest of a row goes through a padded copy.
constexpr std::size_t kBlock = 16;

}  // namespace

FloatCounts convert_to_half(std::span<const float> from, std::uint16_t* to) {
    const auto kernel =
        simd::pick(simd::best_isa(), &avx2::convert_to_half, &avx512::convert_to_half);
    FloatCounts counts;
    const std::size_t whole = from.size() / kBlock * kBlock;
    kernel(from.data(), to, whole, counts);
    if (whole == from.size()) return counts;
    float rest[kBlock] = {};
    std::uint16_t converted[kBlock];
    std::copy(from.begin() + static_cast<std::ptrdiff_t>(whole), from.end(), rest);
    kernel(rest, converted, kBlock, counts);
    std::copy_n(converted, from.size() - whole, to + whole);
    return counts;
}

std::size_t count_non_finite(std::span<const float> values) {
    const auto kernel =
        simd::pick(simd::best_isa(), &avx2::count_non_finite, &avx512::count_non_finite);
    std::size_t non_finite = 0;
    const std::size_t whole = values.size() / kBlock * kBlock;
    kernel(values.data(), whole, non_finite);
    float rest[kBlock] = {};
    std::copy(values.begin() + static_cast<std::ptrdiff_t>(whole), values.end(), rest);
    kernel(rest, kBlock, non_finite);
    return non_finite;
}

}  // namespace penumbra::image
