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

bool filters(const ImageSettings& image) {
    return image.denoise != Denoise::kNone;
}

// What is filtered is measured; where nothing is, E is the shadow's.
void estimate_noise(const FrameInputs& frame, const Film& film, FrameScratch& scratch, Term& term) {
    const ImageSettings& image = frame.image;
    const denoise::NoisePass pass{
        .frame = window_of(film),
        .term = view(std::as_const(term)),
        .noise = term.noise.view(),
        .settings = image.noise,
        .isa = frame.context.isa,
        .noise_of = filters(image) ? plan_of(image.method).noise_of : denoise::NoiseOf::kShadow};
    for_each_band(frame.arena, film, [&](const PixelRect& band, int worker) {
        denoise::estimate_noise(pass, band, scratch.workers[static_cast<std::size_t>(worker)]);
    });
}

// Terms add up: one begins where the ones before it ended.
denoise::CombineInputs inputs_of(const FrameInputs& frame, const Film& film, const Term& term) {
    const bool is_first = &term == &film.terms.front();
    return {.term = view(term),
            .emission = view(is_first ? film.emission : film.beauty),
            .estimator = plan_of(frame.image.method).estimator};
}

denoise::CombineOutputs outputs_of(Film& film, Term& term) {
    return {.beauty = view(film.beauty),
            .ratio = view(term.ratio),
            .shadowed = view(term.filtered_shadowed),
            .unshadowed_samples = view(term.filtered_unshadowed_samples)};
}

// --denoise none.
void combine(const FrameInputs& frame, Film& film, Term& term) {
    const denoise::CombineInputs inputs = inputs_of(frame, film, term);
    const denoise::CombineOutputs outputs = outputs_of(film, term);
    for_each_band(frame.arena, film, [&](const PixelRect& band, int) {
        denoise::combine(window_of(film), inputs, outputs, band, frame.context.isa);
    });
}

// Horizontally in place, then vertically into the picture.
void filter(const FrameInputs& frame, Film& film, FrameScratch& scratch, Term& term) {
    const denoise::FilterGuides guides{.depth = std::as_const(film.depth).view(),
                                       .normal = view(std::as_const(film.geometric_normal)),
                                       .camera = frame.camera};
    const denoise::HorizontalFilterPass horizontal{.frame = window_of(film),
                                                   .guides = guides,
                                                   .term = view(term),
                                                   .settings = frame.image.filter,
                                                   .isa = frame.context.isa};
    for_each_band(frame.arena, film, [&](const PixelRect& band, int worker) {
        denoise::filter_horizontally(horizontal, band.y0, band.y1,
                                     scratch.workers[static_cast<std::size_t>(worker)]);
    });
    const denoise::VerticalFilterPass vertical{.frame = window_of(film),
                                               .guides = guides,
                                               .sums = inputs_of(frame, film, term),
                                               .outputs = outputs_of(film, term),
                                               .settings = frame.image.filter,
                                               .isa = frame.context.isa};
    for_each_band(frame.arena, film,
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
    const ImageSettings& image = frame.image;
    {
        const FramePass noise(Pass::kNoise, frame.profile, statistics);
        prepare_scratch(film, frame.arena.threads(), scratch);
        if (image.passes > 1) average(image.passes, frame.arena, film);
        if (filters(image) || film.wanted.contains(Aov::kE))
            for (Term& term : film.terms) estimate_noise(frame, film, scratch, term);
    }
    const FramePass filtering(Pass::kFilter, frame.profile, statistics);
    for (Term& term : film.terms)
        if (filters(image))
            filter(frame, film, scratch, term);
        else
            combine(frame, film, term);
}

}  // namespace penumbra::renderer
