#pragma once

#include "core/frame/light_sums.h"
#include "shadow/rays.h"

namespace penumbra::shadow {

// Adds the traced rays of a tile to its sums: U_N all weights, S_N those of rays that reach the
// light. Both are added up in the same order, so that they are the same floats where nothing is
// blocked. Only `shadowed` and `unshadowed_samples` of the sums are touched; they start at 0.
void accumulate(const RayScratch& scratch, simd::Isa isa, const LightSumsView& sums);

}  // namespace penumbra::shadow
