#pragma once

#include "core/compare/separable.h"
#include "core/image/plane.h"

// The sRGB curve over regions with their halos. Values are clamped to [0, 1] first: what a display
// shows.

namespace penumbra::compare {

enum class Transfer { kClamp, kEncodeSrgb, kDecodeSrgb };

[[nodiscard]] Plane3<float> transfer(const Plane3<float>& from, Transfer curve,
                                     const Extent& extent);

}  // namespace penumbra::compare
