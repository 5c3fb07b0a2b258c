#pragma once

#include <cstddef>

#include "core/frame/camera.h"
#include "core/frame/surface.h"
#include "core/image/plane_lanes.h"
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
// U_N survives it exactly. (Written as centre + sum(w (x - centre)) / sum(w), each pass may lift W
// by 2 ulp, measured next to centres far brighter than their surroundings.) In return, a change
// within the rounding error of such a sum counts as none, for S_N and U_N together: so constants
// pass unchanged.

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
    F minus_plane;  // -normal . (position - eye), metres
    F minus_scale;  // -settings.plane_weight / length of a pixel's step on the tangent plane
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
    centre.minus_plane = -(guide.depth * centre.slope);

    // A step to the next pixel moves depth * |step| across the view, and the more along it the more
    // edge-on the surface is.
    const F slant = centre.slope_step / simd::min(centre.slope, F(-1e-3f));
    const F pixel = guide.depth * simd::sqrt(simd::fma(slant, slant, F(dot(step, step))));
    centre.minus_scale = F(-settings.plane_weight) / pixel;

    constexpr float kLog2E = 1.44269504f;
    centre.gauss = exp2(F(-kLog2E) / (radius * radius));
    centre.reach = radius * F(2.5f);  // beyond, the Gaussian is below 1/500
    return centre;
}

// The weight of the tap at signed distance `r`, but for the Gaussian. `minus_scale` is the centre's
// over |r|.
template <class F>
F geometry_weight(const FilterCentre<F>& centre, const Guide<F>& tap, F r, F minus_scale,
                  F normal_weight) {
    const F cosine = simd::max(dot(centre.normal, tap.normal), F(0));
    const F square = cosine * cosine;
    const F normal = simd::fma(simd::fma(square, square, F(-1)), normal_weight, F(1));
    const F slope = simd::fma(r, centre.slope_step, centre.slope);
    const F distance = simd::abs(simd::fma(tap.depth, slope, centre.minus_plane));
    const F plane = simd::max(simd::fma(distance, minus_scale, F(1)), F(0));
    return simd::max(normal, F(0)) * (plane * plane);
}

// Where a pixel's guides and sums lie in memory; neighbours are a constant distance apart.
struct FilterSources {
    const float* depth;
    const float* normal[3];
    const float* shadowed[3];            // S_N
    const float* unshadowed_samples[3];  // U_N
};

template <class F>
Guide<F> load_guide(const FilterSources& at, std::ptrdiff_t offset) {
    return {simd::load<F>(at.depth + offset), load3<F>(at.normal, offset)};
}

// S_N and U_N of a pixel, or their weighted sums.
template <class F>
struct Light {
    Vec3<F> shadowed, unshadowed_samples;
};
template <class F>
Light<F> load_light(const FilterSources& at, std::ptrdiff_t offset) {
    return {load3<F>(at.shadowed, offset), load3<F>(at.unshadowed_samples, offset)};
}

// Which taps exist: signed distances, -taps.before ... taps.after.
struct FilterTaps {
    int before, after;
    std::ptrdiff_t step;  // elements from one to the next
};

// Weighted sums over the taps; the centre weighs 1.
template <class F>
struct FilterSums {
    Light<F> light;
    F weights;
};

template <class F>
void add_tap(FilterSums<F>& sums, const FilterSources& at, std::ptrdiff_t offset, F weight) {
    const Light<F> tap = load_light<F>(at, offset);
    sums.light.shadowed = fma(tap.shadowed, weight, sums.light.shadowed);
    sums.light.unshadowed_samples =
        fma(tap.unshadowed_samples, weight, sums.light.unshadowed_samples);
    sums.weights += weight;
}

template <class F>
FilterSums<F> filter_sums(const FilterSources& at, const FilterTaps& taps,
                          const FilterCentre<F>& centre, const FilterSettings& settings) {
    FilterSums<F> sums{load_light<F>(at, 0), F(1)};
    const F normal_weight = F(settings.normal_weight);
    // q^(r r) for r = 1, 2, ...: each is the one before times the next odd power of q.
    F gauss = centre.gauss;
    const F gauss_square = centre.gauss * centre.gauss;
    F gauss_step = gauss_square * centre.gauss;
    for (int r = 1; r <= settings.radius; ++r) {
        const F distance = F(static_cast<float>(r));
        const auto counts = centre.reach >= distance;
        if (simd::none(counts)) break;
        const F weight = simd::select(counts, gauss, F(0));
        const F minus_scale = centre.minus_scale * F(1.0f / static_cast<float>(r));
        const std::ptrdiff_t offset = r * taps.step;
        if (r <= taps.before)
            add_tap(sums, at, -offset,
                    weight * geometry_weight(centre, load_guide<F>(at, -offset), -distance,
                                             minus_scale, normal_weight));
        if (r <= taps.after)
            add_tap(sums, at, offset,
                    weight * geometry_weight(centre, load_guide<F>(at, offset), distance,
                                             minus_scale, normal_weight));
        gauss *= gauss_step;
        gauss_step *= gauss_square;
    }
    return sums;
}

// One channel of S_N and U_N: the means, or what was before if they differ from it by less than the
// sums' rounding error.
template <class F>
void filter_channel(F& shadowed, F& unshadowed_samples, F shadowed_sum, F unshadowed_sum,
                    F inverse_weights) {
    const F s = shadowed_sum * inverse_weights;
    const F u = unshadowed_sum * inverse_weights;
    constexpr float kRounding = 0x1p-18f;  // > (taps of the sum + taps of the weights + 2) / 2^24
    const auto s_changes = simd::abs(s - shadowed) > shadowed * F(kRounding);
    const auto u_changes = simd::abs(u - unshadowed_samples) > unshadowed_samples * F(kRounding);
    const auto changes = s_changes | u_changes;
    shadowed = simd::select(changes, s, shadowed);
    unshadowed_samples = simd::select(changes, u, unshadowed_samples);
}

// The filtered S_N and U_N of a pixel whose Gaussian has this radius.
template <class F>
Light<F> filtered_light(const FilterSources& at, const FilterTaps& taps, F radius,
                        const FilterCentre<F>& centre, const FilterSettings& settings) {
    const FilterSums<F> sums = filter_sums(at, taps, centre, settings);
    const F inverse_weights = F(1) / sums.weights;
    const Light<F> before = load_light<F>(at, 0);
    Vec3<F> s = before.shadowed;
    Vec3<F> u = before.unshadowed_samples;
    const Light<F>& sum = sums.light;
    filter_channel(s.x, u.x, sum.shadowed.x, sum.unshadowed_samples.x, inverse_weights);
    filter_channel(s.y, u.y, sum.shadowed.y, sum.unshadowed_samples.y, inverse_weights);
    filter_channel(s.z, u.z, sum.shadowed.z, sum.unshadowed_samples.z, inverse_weights);
    const auto is_filtered = radius > F(0);
    return {penumbra::select(is_filtered, s, before.shadowed),
            penumbra::select(is_filtered, u, before.unshadowed_samples)};
}

}  // namespace penumbra::denoise
