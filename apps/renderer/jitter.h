#pragma once

#include "core/frame/camera.h"

namespace penumbra::renderer {

// The camera of one of the `passes` --aa passes: sample positions within the pixel from the
// additive recurrence of the plastic number (Roberts, "The Unreasonable Effectiveness of
// Quasirandom Sequences", 2018), which are evenly spread for any count. A single pass samples pixel
// centres.
void jitter(const Camera& camera, int pass, int passes, Camera& jittered);

}  // namespace penumbra::renderer
