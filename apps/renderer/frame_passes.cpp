#include "apps/renderer/frame_passes.h"

#include <algorithm>
#include <utility>

#include "apps/renderer/deposit.h"
#include "apps/renderer/pass_clock.h"
#include "denoise/combine.h"
#include "denoise/joint_bilateral.h"
#include "denoise/noise_estimate.h"
#include "denoise/settings.h"

namespace penumbra::renderer {
namespace {

constexpr int kBandRows =
    16;  // a band is one task: small enough to balance, large enough for its halo

denoise::FrameWindow window_of(const Film& film) {
    return {.width = film.width, .height = film.height, .window = film.window};
}

// Calls body(band, worker) for bands of rows that cover the film's window within the frame.
template <class Body>
void for_each_band(const parallel::Arena& arena, const Film& film, const Body& body) {
    const PixelRect pixels = window_of(film).pixels();
    const int bands = (pixels.height() + kBandRows - 1) / kBandRows;
    arena.for_each(bands, [&](int index, int worker) {
        PixelRect band = pixels;
        band.y0 = pixels.y0 + index * kBandRows;
        band.y1 = std::min(band.y0 + kBandRows, pixels.y1);
        body(band, worker);
    });
}

denoise::CombineInputs sums_of(const Film& film, denoise::Estimator estimator) {
    return {.shadowed = view(film.shadowed),
            .unshadowed_samples = view(film.unshadowed_samples),
            .unshadowed = view(film.unshadowed),
            .emission = view(film.emission),
            .estimator = estimator};
}

denoise::CombineOutputs outputs_of(Film& film) {
    return {.beauty = view(film.beauty), .ratio = view(film.shadow)};
}

// --denoise none.
void combine_film(const ImageSettings& image, const FrameContext& context,
                  const parallel::Arena& arena, Film& film) {
    const denoise::CombineInputs sums = sums_of(film, plan_of(image.method).estimator);
    for_each_band(arena, film, [&](const PixelRect& band, int) {
        denoise::combine(window_of(film), sums, outputs_of(film), band, context.isa);
    });
    // The terms after a filter that does nothing.
    const auto keep = [&](const Plane3<float>& from, Plane3<float>& to) {
        for (std::size_t c = 0; c < 3 && !to[c].empty(); ++c)
            std::copy_n(from[c].row(0), from[c].allocated_elements(), to[c].row(0));
    };
    keep(film.shadowed, film.filtered_shadowed);
    keep(film.unshadowed_samples, film.filtered_unshadowed_samples);
}

bool filters(const ImageSettings& image) {
    return image.denoise != Denoise::kNone;
}

// What is filtered is measured; where nothing is, E is the shadow's.
void estimate_noise(const ImageSettings& image, const FrameContext& context,
                    const parallel::Arena& arena, FrameScratch& scratch, Film& film) {
    const denoise::NoisePass pass{
        .frame = window_of(film),
        .shadowed = view(std::as_const(film.shadowed)),
        .unshadowed_samples = view(std::as_const(film.unshadowed_samples)),
        .unshadowed = view(std::as_const(film.unshadowed)),
        .noise = film.noise.view(),
        .settings = image.noise,
        .isa = context.isa,
        .noise_of = filters(image) ? plan_of(image.method).noise_of : denoise::NoiseOf::kShadow};
    for_each_band(arena, film, [&](const PixelRect& band, int worker) {
        denoise::estimate_noise(pass, band, scratch.workers[static_cast<std::size_t>(worker)]);
    });
}

// Horizontally in place, then vertically into the picture.
void filter(const ImageSettings& image, const FrameContext& context, const Camera& camera,
            const parallel::Arena& arena, FrameScratch& scratch, Film& film) {
    const denoise::FilterGuides guides{.noise = std::as_const(film.noise).view(),
                                       .depth = std::as_const(film.depth).view(),
                                       .normal = view(std::as_const(film.geometric_normal)),
                                       .camera = camera};
    const denoise::HorizontalFilterPass horizontal{
        .frame = window_of(film),
        .guides = guides,
        .shadowed = view(film.shadowed),
        .unshadowed_samples = view(film.unshadowed_samples),
        .settings = image.filter,
        .isa = context.isa};
    for_each_band(arena, film, [&](const PixelRect& band, int worker) {
        denoise::filter_horizontally(horizontal, band.y0, band.y1,
                                     scratch.workers[static_cast<std::size_t>(worker)]);
    });
    const denoise::VerticalFilterPass vertical{
        .frame = window_of(film),
        .guides = guides,
        .sums = sums_of(film, plan_of(image.method).estimator),
        .outputs = outputs_of(film),
        .shadowed = view(film.filtered_shadowed),
        .unshadowed_samples = view(film.filtered_unshadowed_samples),
        .settings = image.filter,
        .isa = context.isa};
    for_each_band(arena, film,
                  [&](const PixelRect& band, int) { denoise::filter_vertically(vertical, band); });
}

void prepare_scratch(const Film& film, int workers, FrameScratch& scratch) {
    if (scratch.window_width == film.window.width()) return;
    scratch.window_width = film.window.width();
    scratch.workers.assign(static_cast<std::size_t>(workers),
                           denoise::Scratch(scratch.window_width));
}

// --aa: sums become means.
void average(int passes, const parallel::Arena& arena, Film& film) {
    for_each_band(arena, film, [&](const PixelRect& band, int) {
        scale_to_means(passes, band.y0 - film.window.y0, band.y1 - film.window.y0, film);
    });
}

}  // namespace

int frame_margin(const ImageSettings& image) {
    const denoise::Margin margin = denoise::chain_margin(image.noise, image.filter);
    return std::max(margin.x, margin.y);
}

void finish_frame(const FrameInputs& frame, FrameScratch& scratch, Film& film,
                  FrameStatistics& statistics) {
    const auto& [image, context, camera, arena, profile] = frame;
    {
        const FramePass noise(Pass::kNoise, profile, statistics);
        prepare_scratch(film, arena.threads(), scratch);
        if (image.passes > 1) average(image.passes, arena, film);
        if (filters(image) || film.wanted.contains(Aov::kE))
            estimate_noise(image, context, arena, scratch, film);
    }
    const FramePass filtering(Pass::kFilter, profile, statistics);
    if (filters(image))
        filter(image, context, camera, arena, scratch, film);
    else
        combine_film(image, context, arena, film);
}

}  // namespace penumbra::renderer
