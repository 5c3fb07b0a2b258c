#include "apps/renderer/frame_passes.h"

#include <algorithm>

#include "apps/renderer/deposit.h"
#include "core/profile/stopwatch.h"
#include "denoise/combine.h"
#include "denoise/settings.h"

namespace penumbra::renderer {
namespace {

constexpr int kBandRows = 16;  // a band is one task: small enough to balance, large enough for its halo

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

void combine_film(const FrameContext& context, const parallel::Arena& arena, Film& film) {
    const denoise::CombineInputs inputs{.shadowed = to_const(view(film.shadowed)),
                                        .unshadowed_samples = to_const(view(film.unshadowed_samples)),
                                        .unshadowed = to_const(view(film.unshadowed)),
                                        .emission = to_const(view(film.emission))};
    const denoise::CombineOutputs outputs{.beauty = view(film.beauty), .ratio = view(film.shadow)};
    for_each_band(arena, film, [&](const PixelRect& band, int) {
        denoise::combine(window_of(film), inputs, outputs, band, context.isa);
    });
}

// --method stochastic: emission + S_N.
void add_samples(const parallel::Arena& arena, Film& film) {
    for_each_band(arena, film, [&](const PixelRect& band, int) {
        for (std::size_t c = 0; c < 3; ++c) {
            for (int y = band.y0 - film.window.y0; y < band.y1 - film.window.y0; ++y) {
                const float* emission = film.emission[c].row(y);
                const float* shadowed = film.shadowed[c].row(y);
                float* beauty = film.beauty[c].row(y);
                for (int x = 0; x < film.window.width(); ++x) beauty[x] = emission[x] + shadowed[x];
            }
        }
    });
}

}  // namespace

int frame_margin(const ImageSettings& image) {
    if (image.denoise == Denoise::kNone || image.method != Method::kRatio) return 0;
    const denoise::Margin margin = denoise::chain_margin(image.noise, image.filter);
    return std::max(margin.x, margin.y);
}

void finish_frame(const ImageSettings& image, const FrameContext& context, const SceneView&,
                  const parallel::Arena& arena, Film& film, FrameStatistics& statistics) {
    profile::Stopwatch watch;
    if (image.passes > 1)
        for_each_band(arena, film, [&](const PixelRect& band, int) {
            scale_to_means(image.passes, band.y0 - film.window.y0, band.y1 - film.window.y0, film);
        });
    combine_film(context, arena, film);
    if (image.method == Method::kStochastic) add_samples(arena, film);
    statistics.passes[Pass::kFilter] = watch.restart();
}

}  // namespace penumbra::renderer
