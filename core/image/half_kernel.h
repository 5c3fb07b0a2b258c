#pragma once

#include <cstddef>
#include <cstdint>

#include "core/image/half.h"

// `count` is a multiple of 16.
namespace penumbra::avx2 {
void convert_to_half(const float* from, std::uint16_t* to, std::size_t count,
                     image::FloatCounts& counts);
void count_non_finite(const float* from, std::size_t count, std::size_t& non_finite);
}  // namespace penumbra::avx2

namespace penumbra::avx512 {
void convert_to_half(const float* from, std::uint16_t* to, std::size_t count,
                     image::FloatCounts& counts);
void count_non_finite(const float* from, std::size_t count, std::size_t& non_finite);
}  // namespace penumbra::avx512
