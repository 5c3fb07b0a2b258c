#pragma once

#include "core/simd/lanes.h"

// Bilinear interpolation in a table of rows of 8 floats, each lane at its own place. Lanes load
// whole rows (two neighbours along the fast axis are 64 contiguous bytes), interpolate them along
// the slow axis as rows, and transpose: less than half the time of gathering each number on its
// own.

namespace penumbra {

inline constexpr int kLtcRowFloats = 8;

template <class F>
struct LtcRow {
    F column[kLtcRowFloats];
};

namespace ltc_detail {

// A place in the table: the index of the lower corner's row, and the position within its cell.
template <class F>
struct Cell {
    simd::IntOf<F> row;
    F slow_fraction, fast_fraction;
};

template <int kSlowNodes, int kFastNodes, class F>
Cell<F> find_cell(const F& slow, const F& fast) {
    const F slow_floor = simd::clamp(simd::floor(slow), F(0), F(kSlowNodes - 2));
    const F fast_floor = simd::clamp(simd::floor(fast), F(0), F(kFastNodes - 2));
    return {simd::to_int(simd::fma(slow_floor, F(kFastNodes), fast_floor)), slow - slow_floor,
            fast - fast_floor};
}

// All paths interpolate along the slow axis first, with the same operations on each number. This
// one: lanes in one cell, as on a surface of one material seen from some way off: nothing to
// transpose.
template <class F>
LtcRow<F> interpolate_within(const float* near_rows, int slow_stride, const Cell<F>& cell) {
    const float* far_rows = near_rows + slow_stride;
    LtcRow<F> row;
    for (int i = 0; i < kLtcRowFloats; ++i) {
        const int next = i + kLtcRowFloats;
        const F lower = simd::lerp(F(near_rows[i]), F(far_rows[i]), cell.slow_fraction);
        const F upper = simd::lerp(F(near_rows[next]), F(far_rows[next]), cell.slow_fraction);
        row.column[i] = simd::lerp(lower, upper, cell.fast_fraction);
    }
    return row;
}

inline LtcRow<float> interpolate(const float* table, int slow_stride, const Cell<float>& cell) {
    return interpolate_within(table + cell.row * kLtcRowFloats, slow_stride, cell);
}

#if defined(__AVX2__) && defined(__FMA__)
// Turns 8 rows into 8 columns.
inline void transpose(__m256 (&row)[8]) {
    __m256 pair[8];
    __m256 quad[8];
    for (int i = 0; i < 8; i += 2) {
        pair[i] = _mm256_unpacklo_ps(row[i], row[i + 1]);
        pair[i + 1] = _mm256_unpackhi_ps(row[i], row[i + 1]);
    }
    for (int i = 0; i < 8; i += 4) {
        for (int j = 0; j < 2; ++j) {
            quad[i + 2 * j] = _mm256_shuffle_ps(pair[i + j], pair[i + j + 2], 0x44);
            quad[i + 2 * j + 1] = _mm256_shuffle_ps(pair[i + j], pair[i + j + 2], 0xEE);
        }
    }
    for (int i = 0; i < 4; ++i) {
        row[i] = _mm256_permute2f128_ps(quad[i], quad[i + 4], 0x20);
        row[i + 4] = _mm256_permute2f128_ps(quad[i], quad[i + 4], 0x31);
    }
}

inline __m256 lerp_rows(__m256 a, __m256 b, __m256 t) {
    return _mm256_fmadd_ps(t, _mm256_sub_ps(b, a), a);
}

inline LtcRow<simd::Float<simd::Avx2>> interpolate(const float* table, int slow_stride,
                                                   const Cell<simd::Float<simd::Avx2>>& cell) {
    alignas(32) std::int32_t row_index[8];
    alignas(32) float slow_fraction[8];
    alignas(32) float fast_fraction[8];
    simd::store(row_index, cell.row);
    if (simd::all(cell.row == row_index[0]))
        return interpolate_within(table + row_index[0] * kLtcRowFloats, slow_stride, cell);
    simd::store(slow_fraction, cell.slow_fraction);
    simd::store(fast_fraction, cell.fast_fraction);
    __m256 row[8];
    for (int lane = 0; lane < 8; ++lane) {
        const float* near_rows = table + row_index[lane] * kLtcRowFloats;
        const float* far_rows = near_rows + slow_stride;
        const __m256 slow = _mm256_broadcast_ss(slow_fraction + lane);
        const __m256 lower = lerp_rows(_mm256_load_ps(near_rows), _mm256_load_ps(far_rows), slow);
        const __m256 upper = lerp_rows(_mm256_load_ps(near_rows + kLtcRowFloats),
                                       _mm256_load_ps(far_rows + kLtcRowFloats), slow);
        row[lane] = lerp_rows(lower, upper, _mm256_broadcast_ss(fast_fraction + lane));
    }
    transpose(row);
    LtcRow<simd::Float<simd::Avx2>> columns;
    for (int i = 0; i < kLtcRowFloats; ++i)
        columns.column[i] = simd::Float<simd::Avx2>::Batch(row[i]);
    return columns;
}
#endif

#if defined(__AVX512F__)
// Sixteen rows of sixteen floats: transposes within their 128-bit quarters, four rows at a time.
inline void transpose_quarters(__m512 (&row)[16]) {
    for (int i = 0; i < 16; i += 4) {
        const __m512 low01 = _mm512_unpacklo_ps(row[i], row[i + 1]);
        const __m512 high01 = _mm512_unpackhi_ps(row[i], row[i + 1]);
        const __m512 low23 = _mm512_unpacklo_ps(row[i + 2], row[i + 3]);
        const __m512 high23 = _mm512_unpackhi_ps(row[i + 2], row[i + 3]);
        row[i] = _mm512_shuffle_ps(low01, low23, 0x44);
        row[i + 1] = _mm512_shuffle_ps(low01, low23, 0xEE);
        row[i + 2] = _mm512_shuffle_ps(high01, high23, 0x44);
        row[i + 3] = _mm512_shuffle_ps(high01, high23, 0xEE);
    }
}

template <int kSelection>
simd::Float<simd::Avx512> join_quarters(__m512 a, __m512 b) {
    return simd::Float<simd::Avx512>::Batch(_mm512_shuffle_f32x4(a, b, kSelection));
}

inline LtcRow<simd::Float<simd::Avx512>> interpolate(const float* table, int slow_stride,
                                                     const Cell<simd::Float<simd::Avx512>>& cell) {
    alignas(64) std::int32_t row_index[16];
    alignas(64) float slow_fraction[16];
    simd::store(row_index, cell.row);
    if (simd::all(cell.row == row_index[0]))
        return interpolate_within(table + row_index[0] * kLtcRowFloats, slow_stride, cell);
    simd::store(slow_fraction, cell.slow_fraction);
    __m512 row[16];
    for (int lane = 0; lane < 16; ++lane) {
        const float* from = table + row_index[lane] * kLtcRowFloats;
        const __m512 near_rows = _mm512_loadu_ps(from);
        const __m512 far_rows = _mm512_loadu_ps(from + slow_stride);
        row[lane] = _mm512_fmadd_ps(_mm512_set1_ps(slow_fraction[lane]),
                                    _mm512_sub_ps(far_rows, near_rows), near_rows);
    }
    transpose_quarters(row);
    LtcRow<simd::Float<simd::Avx512>> columns;
    for (int i = 0; i < 4; ++i) {
        // Quarter q of row[i + 4 b] holds column 4 q + i of the lanes 4 b ... 4 b + 3, where
        // columns 8 to 15 are those of the upper neighbour along the fast axis.
        const __m512 low01 = _mm512_shuffle_f32x4(row[i], row[i + 4], 0x44);
        const __m512 high01 = _mm512_shuffle_f32x4(row[i], row[i + 4], 0xEE);
        const __m512 low23 = _mm512_shuffle_f32x4(row[i + 8], row[i + 12], 0x44);
        const __m512 high23 = _mm512_shuffle_f32x4(row[i + 8], row[i + 12], 0xEE);
        columns.column[i] = simd::lerp(join_quarters<0x88>(low01, low23),
                                       join_quarters<0x88>(high01, high23), cell.fast_fraction);
        columns.column[i + 4] = simd::lerp(join_quarters<0xDD>(low01, low23),
                                           join_quarters<0xDD>(high01, high23), cell.fast_fraction);
    }
    return columns;
}
#endif

}  // namespace ltc_detail

// `table` holds kSlowNodes x kFastNodes rows, aligned to 64 bytes. The positions are in nodes;
// places outside the table extrapolate its last cells, so callers clamp.
template <int kSlowNodes, int kFastNodes, class F>
LtcRow<F> ltc_interpolate_rows(const float* table, const F& slow, const F& fast) {
    const auto cell = ltc_detail::find_cell<kSlowNodes, kFastNodes>(slow, fast);
    return ltc_detail::interpolate(table, kFastNodes * kLtcRowFloats, cell);
}

}  // namespace penumbra
