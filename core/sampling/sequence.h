#pragma once

#include <bit>
#include <cstdint>

#include "core/frame/frame_context.h"
#include "core/math/vec.h"
#include "core/simd/reverse_bits.h"

// Random numbers: Owen-scrambled Sobol points in Z order of the pixels.
//
// The samples of all pixels are one (0,2)-sequence that walks over the frame in Z order, N samples
// at each pixel, so that not only the samples of one pixel are stratified, but also those of each
// aligned square of 2^k x 2^k pixels together: what a filter over neighbouring pixels averages
// converges much faster than independent numbers. Ahmed and Wonka, "Screen-Space Blue-Noise
// Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels" (2020). The order of
// the four quarters of each square is random, by the same hash that scrambles the points: Burley,
// "Practical Hash-based Owen Scrambling" (2020), after Laine and Karras, "Stratified Sampling for
// Stochastic Transparency" (2011). Differs: quarters are permuted by a nested binary scramble (8 of
// the 24 orders), since that is the hash we have anyway.

namespace penumbra {

// What all pixels share: one sequence per use ("dimension": a light, and what is drawn for it),
// frame, pass and seed. Different sequences are independent of each other.
struct Sequence {
    std::uint32_t shuffle_seed = 0;     // of the order in which points are handed out
    std::uint32_t scramble_seed_x = 0;  // of the points' coordinates
    std::uint32_t scramble_seed_y = 0;
    int sample_bits = 0;  // log2 of the samples per pixel, rounded up
};

// `samples` per pixel, 1 to 64, will be drawn from it.
[[nodiscard]] Sequence make_sequence(const FrameContext& frame, std::uint32_t dimension,
                                     int samples);

// A point of [0, 1)^2: sample `sample` of pixel (x, y) of the full frame, below 2^14 each. Pure
// integer arithmetic: the same bits for float and any lane count.
template <class F>
Vec2<F> sequence_point(const Sequence& sequence, simd::UintOf<F> x, simd::UintOf<F> y,
                       std::uint32_t sample);

// A bijective 32-bit hash with good avalanche, and the hash of two numbers.
[[nodiscard]] constexpr std::uint32_t hash_bits(std::uint32_t x) {
    // The constants are Ettinger's, found by exhaustive search ("hash-prospector", 2018): bias
    // 0.17.
    x ^= x >> 16;
    x *= 0x21f0aaadu;
    x ^= x >> 15;
    x *= 0xd35a2d97u;
    return x ^ (x >> 15);
}
[[nodiscard]] constexpr std::uint32_t hash_pair(std::uint32_t a, std::uint32_t b) {
    return hash_bits(a ^ (hash_bits(b) + 0x9e3779b9u + (a << 6) + (a >> 2)));
}

// ---- implementation --------------------------------------------------------------------------

namespace sequence_detail {

// Moves bit i to bit 2 i.
template <class U>
U spread_bits(U x) {
    x = (x | (x << 8)) & U(0x00ff00ffu);
    x = (x | (x << 4)) & U(0x0f0f0f0fu);
    x = (x | (x << 2)) & U(0x33333333u);
    return (x | (x << 1)) & U(0x55555555u);
}

// A random permutation in which each bit depends on itself and the lower ones: an Owen scramble,
// with the most significant bit of the scrambled number lying at the bottom. Constants: Vegdahl,
// "Owen Scrambling Based Dithered Blue-Noise Sampling" (2021).
template <class U>
U permute_upwards(U x, std::uint32_t seed) {
    x ^= x * U(0x3d20adeau);
    x += U(seed);
    x *= U((seed >> 16) | 1u);
    x ^= x * U(0x05526c56u);
    x ^= x * U(0x53a22864u);
    return x;
}

// The second dimension of Sobol's sequence, most significant bit at the bottom: the generator
// matrix is Pascal's triangle modulo 2, a product of five sparse factors.
template <class U>
U second_dimension(U index) {
    index ^= (index >> 1) & U(0x55555555u);
    index ^= (index >> 2) & U(0x33333333u);
    index ^= (index >> 4) & U(0x0f0f0f0fu);
    index ^= (index >> 8) & U(0x00ff00ffu);
    return index ^ ((index >> 16) & U(0x0000ffffu));
}

template <class F, class U>
F unit_interval(U bits) {
    const auto top = simd::IntOf<F>(bits >> 8);
    if constexpr (std::is_arithmetic_v<F>)
        return static_cast<F>(top) * F(0x1p-24f);
    else
        return simd::to_float(top) * F(0x1p-24f);
}

}  // namespace sequence_detail

template <class F>
Vec2<F> sequence_point(const Sequence& sequence, simd::UintOf<F> x, simd::UintOf<F> y,
                       std::uint32_t sample) {
    using namespace sequence_detail;
    using simd::reverse_bits;
    using U = simd::UintOf<F>;
    const U z_order = spread_bits(x) | (spread_bits(y) << 1);
    const U ordered = (z_order << sequence.sample_bits) | U(sample);
    const U index = reverse_bits(permute_upwards(reverse_bits(ordered), sequence.shuffle_seed));
    const U first = reverse_bits(permute_upwards(index, sequence.scramble_seed_x));
    const U second =
        reverse_bits(permute_upwards(second_dimension(index), sequence.scramble_seed_y));
    return {unit_interval<F>(first), unit_interval<F>(second)};
}

}  // namespace penumbra
