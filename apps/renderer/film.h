#pragma once

#include <vector>

#include "apps/renderer/aov.h"
#include "core/frame/term.h"

namespace penumbra::renderer {

// A channel of an AOV that the film takes from the tiles; one of the two, or neither.
struct AovPlane {
    Plane<float> numbers;
    Plane<std::uint32_t> ids;
};

// The full-frame planes of one frame: what the denoiser reads, what it writes, and the AOVs that
// were asked for. Planes cover `window`, so that window pixel (0, 0) is full-frame pixel
// (window.x0, window.y0).
struct Film {
    int width = 0, height = 0;  // of the full frame
    PixelRect crop;             // what the user wants, inside the full frame
    PixelRect window;           // crop + the filters' margin, in whole tiles: what is rendered
    AovSet wanted;

    // All light, in parts that are filtered apart and add up. The renderer makes one, the total.
    // The tile passes leave U, S_N and U_N, sums over the --aa passes until they are scaled to
    // means; E and what is filtered are the frame passes'.
    std::vector<Term> terms;

    // Left behind by the tile passes; sums likewise.
    Plane3<float> emission;
    Plane<float> depth;  // first --aa pass, as is the normal
    Plane3<float> geometric_normal;

    // Left behind by the frame passes.
    Plane3<float> beauty;

    // What nobody but the file reads, only if wanted: per AOV and channel.
    std::vector<std::vector<AovPlane>> taken;

    // A wanted AOV's channel, wherever it is held.
    [[nodiscard]] const Plane<float>& numbers(Aov aov, std::size_t channel) const;
    [[nodiscard]] const Plane<std::uint32_t>& ids(Aov aov, std::size_t channel) const;

    // The only term: all light, which tiles add to and which the AOVs U, S, Un, W and E show.
    [[nodiscard]] Term& total();
    [[nodiscard]] const Term& total() const;
};

// Allocates the planes, anew only where the size or the wanted set changed.
void prepare_film(int width, int height, PixelRect crop, int margin, AovSet wanted, Film& film);

}  // namespace penumbra::renderer
