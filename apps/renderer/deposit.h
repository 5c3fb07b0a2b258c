#pragma once

#include "apps/renderer/film.h"

namespace penumbra::renderer {

// Moves what a tile's passes left in scratch to the film: the first --aa pass stores, the others
// add radiance, terms and the AOVs that are means, and leave the rest alone.
void deposit(const TileResult& from, Film& film);

// Turns the sums of `passes` passes into means, for the rows [y0, y1) of the film's window.
void scale_to_means(int passes, int y0, int y1, Film& film);

}  // namespace penumbra::renderer
