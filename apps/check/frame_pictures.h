#pragma once

#include <string>

#include "apps/check/outcome.h"

namespace penumbra::check {

// A frame as a piece of HTML: viewers and numbers where it differs from its golden, else one
// picture. The comparison still has its pictures.
[[nodiscard]] std::string frame_pictures(const FrameOutcome& frame);

}  // namespace penumbra::check
