#pragma once

#include <string>

#include "apps/cli/render_options.h"
#include "apps/renderer/sequence.h"

namespace penumbra::cli {

// Times and counts per frame and pass as JSON; docs/statistics.md explains the keys.
void write_statistics(const std::string& path, const Scene& scene, const RenderOptions& options,
                      const renderer::SequenceReport& report);

}  // namespace penumbra::cli
