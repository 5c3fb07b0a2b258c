#pragma once

#include "core/sampling/polygon.h"
#include "core/sampling/sequence.h"

// The same samples by lanes: sequence points of a row of pixels, and the places they choose on a
// light from points along the x axis.

namespace penumbra {

inline constexpr int kSampledPixels = 64;

struct SampledRow {
    PolygonShape<float> light;
    Sequence sequence;
    float x[kSampledPixels], y[kSampledPixels];  // sequence points
    Vec3f place[kSampledPixels];
    float solid_angle[kSampledPixels];
};

// Pixels from `first` on, as many as F has lanes.
template <class F>
void sample_row(SampledRow& row, int first) {
    using U = simd::UintOf<F>;
    const U pixel = U(static_cast<std::uint32_t>(first)) + simd::iota<U>();
    const Vec2<F> random = sequence_point<F>(row.sequence, pixel, U(5u), 0);
    simd::store(row.x + first, random.x);
    simd::store(row.y + first, random.y);
    const F along = simd::to_float(simd::IntOf<F>(pixel)) * F(0.05f) - F(1.5f);
    const auto seen = see_polygon<F>(row.light, {along, F(0), F(0)}, {F(0.6f), F(0), F(0.8f)});
    const auto sampler = make_polygon_sampler(row.light, seen);
    const Vec3<F> place = sample_polygon(row.light, seen, sampler, random);
    float values[4][16];
    simd::store(values[0], place.x);
    simd::store(values[1], place.y);
    simd::store(values[2], place.z);
    simd::store(values[3], sampler.solid_angle);
    for (int lane = 0; lane < simd::kLanes<F>; ++lane) {
        row.place[first + lane] = {values[0][lane], values[1][lane], values[2][lane]};
        row.solid_angle[first + lane] = values[3][lane];
    }
}

namespace avx2 {
void sample_whole_row(SampledRow& row);
}
namespace avx512 {
void sample_whole_row(SampledRow& row);
}

}  // namespace penumbra
