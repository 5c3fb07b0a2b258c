#pragma once

#include <vector>

#include "apps/renderer/film.h"
#include "apps/renderer/frame_statistics.h"
#include "apps/renderer/settings.h"
#include "core/frame/camera.h"
#include "core/frame/frame_context.h"
#include "core/parallel/arena.h"
#include "denoise/scratch.h"

namespace penumbra::renderer {

// Pixels around a crop that the frame passes read.
[[nodiscard]] int frame_margin(const ImageSettings& image);

// What the workers of the frame passes need; kept from frame to frame.
struct FrameScratch {
    int window_width = 0;
    std::vector<denoise::Scratch> workers;
};

// What all passes of a frame know.
struct FrameInputs {
    const ImageSettings& image;
    const FrameContext& context;
    const Camera& camera;
    const parallel::Arena& arena;
    profile::Profile* profile;  // may be null
};

// The passes of a whole frame, after all its tiles: means of the --aa passes, noise estimate,
// filter, combine.
void finish_frame(const FrameInputs& frame, FrameScratch& scratch, Film& film,
                  FrameStatistics& statistics);

}  // namespace penumbra::renderer
