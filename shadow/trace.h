#pragma once

#include "shadow/occluders.h"
#include "shadow/rays.h"

namespace penumbra::shadow {

// kForcedToOne lets every ray reach its light without tracing it: a tool for tests, in which the
// denoised frame must equal emission + U.
enum class Visibility { kTraced, kForcedToOne };

// Finds which of the active rays reach their light: packs them, four by four pixels at a time along
// a Z curve, and asks the occluders once per tile.
void trace(const Occluders& occluders, Visibility visibility, RayScratch& scratch);

}  // namespace penumbra::shadow
