#pragma once

#include <string>

#include "apps/renderer/output_settings.h"
#include "apps/renderer/settings.h"
#include "core/scene/scene.h"

namespace penumbra::renderer {

// All settings that a frame's file depends on (settings_table.h), as on the command line: "size
// 1920x1080, ..., method ratio, spp 1, ...". No threads, no paths. `image` is complete
// (completed(), renderer.h).
[[nodiscard]] std::string describe_settings(const ImageSettings& image,
                                            const ExecutionSettings& execution,
                                            const OutputSettings& output);

// Of the scene's files, the settings and the version.
[[nodiscard]] std::string settings_digest(const Scene& scene, const std::string& settings);

// Of one frame of them.
[[nodiscard]] std::string frame_digest(const std::string& digest, int frame);

}  // namespace penumbra::renderer
