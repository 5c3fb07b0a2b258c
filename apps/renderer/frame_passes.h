#pragma once

#include "apps/renderer/film.h"
#include "apps/renderer/frame_statistics.h"
#include "apps/renderer/settings.h"
#include "core/frame/frame_context.h"
#include "core/frame/scene_view.h"
#include "core/parallel/arena.h"

namespace penumbra::renderer {

// Pixels around a crop that the frame passes read.
[[nodiscard]] int frame_margin(const ImageSettings& image);

// The passes of a whole frame, after all its tiles: means of the --aa passes, noise estimate, filter,
// combine.
void finish_frame(const ImageSettings& image, const FrameContext& context, const SceneView& view,
                  const parallel::Arena& arena, Film& film, FrameStatistics& statistics);

}  // namespace penumbra::renderer
