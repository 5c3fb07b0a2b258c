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

}  // namespace

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
    const auto plane = [&] { return Plane<float>(window.width(), window.height()); };
    const auto plane3 = [&] { return make_plane3<float>(window.width(), window.height()); };
    const auto ids = [&] { return Plane<std::uint32_t>(window.width(), window.height()); };

    film.terms.push_back(make_term(window, wanted));
    film.emission = plane3();
    film.coverage = plane();
    film.depth = plane();
    film.geometric_normal = plane3();
    film.beauty = plane3();
    if (wanted.contains(Aov::kP)) film.position = plane3();
    if (wanted.contains(Aov::kN)) film.normal = plane3();
    if (wanted.contains(Aov::kAlbedo)) film.base_color = plane3();
    if (wanted.contains(Aov::kRoughness)) film.roughness = plane();
    if (wanted.contains(Aov::kMetallic)) film.metallic = plane();
    if (wanted.contains(Aov::kMotion)) {
        film.motion_x = plane();
        film.motion_y = plane();
    }
    if (wanted.contains(Aov::kId)) {
        film.instance = ids();
        film.triangle = ids();
        film.material = ids();
    }
}

}  // namespace penumbra::renderer
