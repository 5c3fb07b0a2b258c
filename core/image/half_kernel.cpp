#include "core/image/half_kernel.h"

#include <immintrin.h>

#include <limits>

#include "core/simd/kernel.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

// The processor's conversion: to nearest even, whatever the rounding mode and flush-to-zero say.
void store_as_half(std::uint16_t* to, F value) {
    constexpr int kRounding = _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC;
#if defined(__AVX512F__)
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_cvtps_ph(value.v, kRounding));
#else
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm256_cvtps_ph(value.v, kRounding));
#endif
}

std::size_t count(M mask) {
    return static_cast<std::size_t>(__builtin_popcount(simd::bits(mask)));
}

}  // namespace

void convert_to_half(const float* from, std::uint16_t* to, std::size_t count_of_values,
                     image::FloatCounts& counts) {
    const F largest(image::kLargestHalf);
    for (std::size_t i = 0; i < count_of_values; i += kLanes) {
        const F value = simd::load<F>(from + i);
        const F magnitude = simd::abs(value);
        const M finite = magnitude <= F(std::numeric_limits<float>::max());
        const M beyond = finite & (magnitude > largest);
        counts.clamped += count(beyond);
        counts.non_finite += kLanes - count(finite);
        store_as_half(to + i, simd::select(beyond, simd::copysign(largest, value), value));
    }
}

void count_non_finite(const float* from, std::size_t count_of_values, std::size_t& non_finite) {
    for (std::size_t i = 0; i < count_of_values; i += kLanes) {
        const F magnitude = simd::abs(simd::load<F>(from + i));
        non_finite += kLanes - count(magnitude <= F(std::numeric_limits<float>::max()));
    }
}

}  // namespace penumbra::PENUMBRA_ISA
