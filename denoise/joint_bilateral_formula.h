#pragma once

#include <cstddef>

#include "core/frame/camera.h"
#include "core/frame/surface.h"
#include "core/math/elementary.h"
#include "core/math/vec.h"
#include "denoise/settings.h"

// A joint bilateral filter along one direction. Heitz, Hill and McGuire (2018), section 4.3: a
// Gaussian whose width follows the noise E, times weights from the G-buffer, the same for S_N and
// U_N.
//
// Differs: the distance of a tap from the centre's tangent plane is measured against the tap's own
// distance, in pixels stretched by the surface's slant, and not in metres; it serves for the depth
// weight too, which would reject slanted floors. A filtered value is sum(w x) / sum(w) over
// non-negative numbers: each of its operations is monotone also when rounded, and so 0 <= S_N <=
// U_N survives it exactly. (Written as centre + sum(w (x - centre)) / sum(w) it does not: next to a
// centre that is far brighter than its surroundings the last bits of W are lost.) In return, a
// change within the rounding error of such a sum counts as none, for S_N and U_N together: so
// constants pass unchanged.

namespace penumbra::denoise {

// One element of the guides, in lanes.
template <class F>
struct Guide {
    F depth;
    Vec3<F> normal;
};

// Radius of the Gaussian exp(-(r / radius)^2), in pixels; 0 where the pixel passes unchanged.
template <class F>
F gaussian_radius(F noise, F depth, const FilterSettings& settings) {
    const F radius = simd::saturate(noise * F(settings.radius_per_noise)) *
                     F(static_cast<float>(settings.radius));
    const auto is_filtered = (radius > F(settings.smallest_radius)) & (depth < F(kDepthOfNothing));
    return simd::select(is_filtered, radius, F(0));
}

// What the weights of a pixel's taps need, along one direction of the image.
template <class F>
struct FilterCentre {
    Vec3<F> normal;
    F slope;        // normal . (view direction through the pixel, of view depth 1)
    F slope_step;   // its change from one tap to the next
    F plane;        // normal . (position - eye), metres
    F plane_scale;  // settings.plane_weight / length of a pixel's step on the tangent plane
    F gauss;        // the Gaussian at one pixel's distance
    F reach;        // taps up to here count, pixels
};

// `step` is the change of `direction` from one tap to the next: camera.right / focal along a row,
// -camera.up / focal down a column.
template <class F>
FilterCentre<F> filter_centre(const Guide<F>& guide, F radius, const Vec3<F>& direction,
                              const Vec3f& step, const FilterSettings& settings) {
    FilterCentre<F> centre;
    centre.normal = guide.normal;
    centre.slope = dot(guide.normal, direction);
    centre.slope_step = dot(guide.normal, broadcast<F>(step));
    centre.plane = guide.depth * centre.slope;

    // A step to the next pixel moves depth * |step| across the view, and the more along it the more
    // edge-on the surface is.
    const F slant = centre.slope_step / simd::min(centre.slope, F(-1e-3f));
    const F pixel = guide.depth * simd::sqrt(simd::fma(slant, slant, F(dot(step, step))));
    centre.plane_scale = F(settings.plane_weight) / pixel;

    constexpr float kLog2E = 1.44269504f;
    centre.gauss = exp2(F(-kLog2E) / (radius * radius));
    centre.reach = radius * F(2.5f);  // beyond, the Gaussian is below 1/500
    return centre;
}

// The weight of the tap at signed distance `r`, but for the Gaussian. `plane_scale` is the centre's
// over |r|.
template <class F>
F geometry_weight(const FilterCentre<F>& centre, const Guide<F>& tap, F r, F plane_scale,
                  F normal_weight) {
    const F cosine = simd::max(dot(centre.normal, tap.normal), F(0));
    const F square = cosine * cosine;
    const F normal = simd::fma(simd::fma(square, square, F(-1)), normal_weight, F(1));
    const F slope = simd::fma(r, centre.slope_step, centre.slope);
    const F distance = simd::abs(simd::fma(tap.depth, slope, -centre.plane));
    const F plane = simd::max(simd::fma(-distance, plane_scale, F(1)), F(0));
    return simd::max(normal, F(0)) * (plane * plane);
}

// Where a pixel's guides and sums lie in memory; neighbours are a constant distance apart.
struct FilterSources {
    static constexpr int kSums = 6;  // S_N's channels, then U_N's
    const float* depth;
    const float* normal[3];
    const float* sums[kSums];

    template <class F>
    [[nodiscard]] Guide<F> guide(std::ptrdiff_t offset) const {
        return {simd::load<F>(depth + offset),
                {simd::load<F>(normal[0] + offset), simd::load<F>(normal[1] + offset),
                 simd::load<F>(normal[2] + offset)}};
    }
};

// Weighted sums over the taps, the centre's weight being 1.
template <class F>
struct FilterSums {
    F sums[FilterSources::kSums];
    F weights = F(1);

    explicit FilterSums(const FilterSources& at) {
        for (int i = 0; i < FilterSources::kSums; ++i) sums[i] = simd::load<F>(at.sums[i]);
    }
    void add(const FilterSources& at, std::ptrdiff_t offset, F weight) {
        weights += weight;
        for (int i = 0; i < FilterSources::kSums; ++i)
            sums[i] = simd::fma(weight, simd::load<F>(at.sums[i] + offset), sums[i]);
    }
};

// Which taps exist: signed distances, -taps.before ... taps.after.
struct FilterTaps {
    int before, after;
    std::ptrdiff_t step;  // elements from one to the next
};

template <class F>
FilterSums<F> filter_sums(const FilterSources& at, const FilterTaps& taps,
                          const FilterCentre<F>& centre, const FilterSettings& settings) {
    FilterSums<F> result(at);
    const F normal_weight = F(settings.normal_weight);
    // q^(r r) for r = 1, 2, ...: each is the one before times the next odd power of q.
    F gauss = centre.gauss;
    const F gauss_square = centre.gauss * centre.gauss;
    F gauss_step = gauss_square * centre.gauss;
    for (int r = 1; r <= settings.radius; ++r) {
        const auto counts = centre.reach >= F(static_cast<float>(r));
        if (simd::none(counts)) break;
        const F weight = simd::select(counts, gauss, F(0));
        const F plane_scale = centre.plane_scale * F(1.0f / static_cast<float>(r));
        for (const int tap : {-r, r}) {
            if (tap < -taps.before || tap > taps.after) continue;
            const std::ptrdiff_t offset = tap * taps.step;
            const F geometry =
                geometry_weight(centre, at.guide<F>(offset), F(static_cast<float>(tap)),
                                plane_scale, normal_weight);
            result.add(at, offset, weight * geometry);
        }
        gauss *= gauss_step;
        gauss_step *= gauss_square;
    }
    return result;
}

// A channel of S_N and U_N.
template <class F>
struct ChannelPair {
    F shadowed, unshadowed_samples;
};

// The filtered pair, or the pair before if the change is within the sums' rounding error.
template <class F>
ChannelPair<F> filtered_channel(const ChannelPair<F>& before, const ChannelPair<F>& sums,
                                F inverse_weights) {
    const F s = sums.shadowed * inverse_weights;
    const F u = sums.unshadowed_samples * inverse_weights;
    constexpr float kRounding = 0x1p-18f;  // > (taps of the sum + taps of the weights + 2) / 2^24
    const auto is_same =
        (simd::abs(s - before.shadowed) <= before.shadowed * F(kRounding)) &
        (simd::abs(u - before.unshadowed_samples) <= before.unshadowed_samples * F(kRounding));
    return {simd::select(is_same, before.shadowed, s),
            simd::select(is_same, before.unshadowed_samples, u)};
}

}  // namespace penumbra::denoise
