#include "denoise/joint_bilateral_kernel.h"

#include "core/image/plane_lanes.h"
#include "core/simd/kernel.h"
#include "denoise/estimator.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

using denoise::ColumnFilter;
using denoise::FilterSources;
using denoise::FilterTaps;
using denoise::kBlock;
using denoise::RowFilter;

// The direction through the centres of the pixels from element (x, y) on.
Vec3<F> direction(const denoise::FilterGuides& guides, const PixelRect& window, int x, int y) {
    const F column = simd::to_float(I(x + window.x0) + simd::iota<I>()) + F(0.5f);
    return guides.camera.direction(column, F(static_cast<float>(y + window.y0) + 0.5f));
}

using Light = denoise::Light<F>;

// S_N and U_N of the pixels at `at`; those of radius 0 come out unchanged.
Light filter_pixels(const FilterSources& at, const FilterTaps& taps, F radius,
                    const Vec3<F>& view_direction, const Vec3f& step,
                    const denoise::FilterSettings& settings) {
    const auto centre = denoise::filter_centre(denoise::load_guide<F>(at, 0), radius,
                                               view_direction, step, settings);
    return denoise::filtered_light(at, taps, radius, centre, settings);
}

// ---- along rows ------------------------------------------------------------------------------

M exists(const RowFilter& filter, int x) {
    const I column = I(x) + simd::iota<I>();
    return (column >= I(filter.existing.x0)) & (column < I(filter.existing.x1));
}

F row_radius(const RowFilter& filter, int x, int y) {
    const denoise::HorizontalFilterPass& pass = *filter.pass;
    const F radius =
        denoise::gaussian_radius(simd::load<F>(pass.term.noise.row(y) + x),
                                 simd::load<F>(pass.guides.depth.row(y) + x), pass.settings);
    return simd::select(exists(filter, x), radius, F(0));
}

// Does any pixel of this block of the row change?
bool is_active(const RowFilter& filter, int block, int blocks, int y) {
    if (block < 0 || block >= blocks) return false;
    for (int lane = 0; lane < kBlock; lane += kLanes)
        if (simd::any(row_radius(filter, block * kBlock + lane, y) > F(0))) return true;
    return false;
}

float* scratch_row(const RowFilter& filter, int plane) {
    const std::size_t stride = denoise::filter_row_stride(filter.pass->frame.window.width());
    return filter.scratch + static_cast<std::size_t>(plane) * stride + kBlock;
}

// Copies a block to scratch; what does not exist becomes 0, which weighs nothing.
void copy_block(const RowFilter& filter, int block, int blocks, int y) {
    const denoise::HorizontalFilterPass& pass = *filter.pass;
    const bool is_inside = block >= 0 && block < blocks;
    const auto copy = [&](int plane, const auto& from) {
        for (int x = block * kBlock; x < (block + 1) * kBlock; x += kLanes)
            simd::store(scratch_row(filter, plane) + x,
                        is_inside
                            ? simd::select(exists(filter, x), simd::load<F>(from.row(y) + x), F(0))
                            : F(0));
    };
    copy(0, pass.guides.depth);
    for (int i = 0; i < 3; ++i) {
        const auto channel = static_cast<std::size_t>(i);
        copy(1 + i, pass.guides.normal[channel]);
        copy(4 + i, pass.term.shadowed[channel]);
        copy(7 + i, pass.term.unshadowed_samples[channel]);
    }
}

FilterSources row_sources(const RowFilter& filter, int x) {
    FilterSources at;
    at.depth = scratch_row(filter, 0) + x;
    for (int i = 0; i < 3; ++i) {
        at.normal[i] = scratch_row(filter, 1 + i) + x;
        at.shadowed[i] = scratch_row(filter, 4 + i) + x;
        at.unshadowed_samples[i] = scratch_row(filter, 7 + i) + x;
    }
    return at;
}

void filter_block(const RowFilter& filter, int block, int y) {
    const denoise::HorizontalFilterPass& pass = *filter.pass;
    const FilterTaps taps{pass.settings.radius, pass.settings.radius, 1};
    for (int x = block * kBlock; x < (block + 1) * kBlock; x += kLanes) {
        const F radius = row_radius(filter, x, y);
        if (simd::none(radius > F(0))) continue;
        const Light light = filter_pixels(row_sources(filter, x), taps, radius,
                                          direction(pass.guides, pass.frame.window, x, y),
                                          filter.step, pass.settings);
        store3(pass.term.shadowed, x, y, light.shadowed);
        store3(pass.term.unshadowed_samples, x, y, light.unshadowed_samples);
    }
}

}  // namespace

// Copying runs one block ahead of filtering, so that taps find the values of before the pass.
void filter_row(const RowFilter& filter, int y) {
    const int blocks = (filter.existing.x1 + kBlock - 1) / kBlock;
    bool is_active_before = false;
    bool is_active_here = false;
    bool is_active_after = is_active(filter, 0, blocks, y);
    for (int block = -1; block <= blocks; ++block) {
        if (is_active_before || is_active_here || is_active_after)
            copy_block(filter, block, blocks, y);
        if (is_active_before) filter_block(filter, block - 1, y);
        is_active_before = is_active_here;
        is_active_here = is_active_after;
        is_active_after = is_active(filter, block + 2, blocks, y);
    }
}

// ---- down columns ----------------------------------------------------------------------------

namespace {

FilterSources column_sources(const denoise::VerticalFilterPass& pass, int x, int y) {
    FilterSources at;
    at.depth = pass.guides.depth.row(y) + x;
    for (std::size_t i = 0; i < 3; ++i) {
        at.normal[i] = pass.guides.normal[i].row(y) + x;
        at.shadowed[i] = pass.sums.term.shadowed[i].row(y) + x;
        at.unshadowed_samples[i] = pass.sums.term.unshadowed_samples[i].row(y) + x;
    }
    return at;
}

void finish_channel(const denoise::VerticalFilterPass& pass, std::size_t channel, int x, int y,
                    F shadowed, F unshadowed_samples) {
    const denoise::CombineInputs& sums = pass.sums;
    const F emission = simd::load<F>(sums.emission[channel].row(y) + x);
    const F unshadowed = simd::load<F>(sums.term.unshadowed[channel].row(y) + x);
    simd::store(
        pass.outputs.beauty[channel].row(y) + x,
        denoise::finish(sums.estimator, emission, unshadowed, shadowed, unshadowed_samples));
    if (pass.outputs.ratio[channel])
        simd::store(pass.outputs.ratio[channel].row(y) + x,
                    denoise::shadow_ratio(shadowed, unshadowed_samples));
}

void write_outputs(const denoise::VerticalFilterPass& pass, int x, int y, const Light& light) {
    const Vec3<F>& s = light.shadowed;
    const Vec3<F>& u = light.unshadowed_samples;
    finish_channel(pass, 0, x, y, s.x, u.x);
    finish_channel(pass, 1, x, y, s.y, u.y);
    finish_channel(pass, 2, x, y, s.z, u.z);
    const denoise::CombineOutputs& outputs = pass.outputs;
    if (outputs.shadowed[0]) store3(outputs.shadowed, x, y, s);
    if (outputs.unshadowed_samples[0]) store3(outputs.unshadowed_samples, x, y, u);
}

void filter_and_combine(const ColumnFilter& filter, int x, int y) {
    const denoise::VerticalFilterPass& pass = *filter.pass;
    const FilterSources at = column_sources(pass, x, y);
    const F radius = denoise::gaussian_radius(simd::load<F>(pass.sums.term.noise.row(y) + x),
                                              simd::load<F>(at.depth), pass.settings);
    if (simd::none(radius > F(0))) {
        write_outputs(pass, x, y, denoise::load_light<F>(at, 0));
        return;
    }
    const FilterTaps taps{y - filter.existing.y0, filter.existing.y1 - 1 - y,
                          pass.guides.depth.stride};
    write_outputs(pass, x, y,
                  filter_pixels(at, taps, radius, direction(pass.guides, pass.frame.window, x, y),
                                filter.step, pass.settings));
}

}  // namespace

void filter_columns(const ColumnFilter& filter, const PixelRect& elements) {
    for (int y = elements.y0; y < elements.y1; ++y)
        for (int x = elements.x0; x < elements.x1; x += kLanes) filter_and_combine(filter, x, y);
}

}  // namespace penumbra::PENUMBRA_ISA
