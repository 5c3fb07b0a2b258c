#include "apps/renderer/film.h"

#include <algorithm>

#include "core/error.h"

namespace penumbra::renderer {
namespace {

int tile_floor(int x) {
    return x / kTileSize * kTileSize;
}
int tile_ceiling(int x) {
    return (x + kTileSize - 1) / kTileSize * kTileSize;
}

// The crop with its margin, in whole tiles of the full frame (the last row and column may stick
// out).
PixelRect rendered_window(int width, int height, PixelRect crop, int margin) {
    return {.x0 = tile_floor(std::max(crop.x0 - margin, 0)),
            .y0 = tile_floor(std::max(crop.y0 - margin, 0)),
            .x1 = tile_ceiling(std::min(crop.x1 + margin, width)),
            .y1 = tile_ceiling(std::min(crop.y1 + margin, height))};
}

Term make_term(const PixelRect& window, AovSet wanted) {
    const auto plane3 = [&] { return make_plane3<float>(window.width(), window.height()); };
    Term term{.unshadowed = plane3(),
              .shadowed = plane3(),
              .unshadowed_samples = plane3(),
              .noise = Plane<float>(window.width(), window.height())};
    if (wanted.contains(Aov::kW)) term.ratio = plane3();
    if (wanted.contains(Aov::kS)) term.filtered_shadowed = plane3();
    if (wanted.contains(Aov::kUn)) term.filtered_unshadowed_samples = plane3();
    return term;
}

// Planes for the channels that come from tiles.
std::vector<AovPlane> make_planes(const PixelRect& window, const AovInfo& aov) {
    const std::span<const AovChannel> channels = aov.channels();
    std::vector<AovPlane> planes(channels.size());
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const AovSource& source = channels[i].source;
        if (std::holds_alternative<SurfaceIds>(source))
            planes[i].ids = Plane<std::uint32_t>(window.width(), window.height());
        else if (!std::holds_alternative<FilmPlane>(source))
            planes[i].numbers = Plane<float>(window.width(), window.height());
    }
    return planes;
}

}  // namespace

const Plane<float>& Film::numbers(Aov aov, std::size_t channel) const {
    const FilmPlane* const held = std::get_if<FilmPlane>(&info(aov).slots[channel].source);
    return held ? (*held)(*this) : taken[static_cast<std::size_t>(aov)][channel].numbers;
}
const Plane<std::uint32_t>& Film::ids(Aov aov, std::size_t channel) const {
    return taken[static_cast<std::size_t>(aov)][channel].ids;
}

Term& Film::total() {
    PENUMBRA_ASSERT(terms.size() == 1, "{} terms", terms.size());
    return terms.front();
}
const Term& Film::total() const {
    PENUMBRA_ASSERT(terms.size() == 1, "{} terms", terms.size());
    return terms.front();
}

void prepare_film(int width, int height, PixelRect crop, int margin, AovSet wanted, Film& film) {
    const PixelRect window = rendered_window(width, height, crop, margin);
    const bool fits = film.window == window && film.wanted == wanted && !film.depth.empty();
    film.width = width;
    film.height = height;
    film.crop = crop;
    if (fits) return;

    film = Film{.width = width, .height = height, .crop = crop, .window = window, .wanted = wanted};
    const auto plane3 = [&] { return make_plane3<float>(window.width(), window.height()); };

    film.terms.push_back(make_term(window, wanted));
    film.emission = plane3();
    film.depth = Plane<float>(window.width(), window.height());
    film.geometric_normal = plane3();
    film.beauty = plane3();
    film.taken.resize(aov_table().size());
    for (const AovInfo& aov : aov_table())
        if (wanted.contains(aov.aov))
            film.taken[static_cast<std::size_t>(aov.aov)] = make_planes(window, aov);
}

}  // namespace penumbra::renderer
