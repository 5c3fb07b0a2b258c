#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "apps/renderer/frame_statistics.h"
#include "apps/renderer/output_settings.h"
#include "apps/renderer/settings.h"
#include "core/scene/scene.h"

namespace penumbra::renderer {

enum class FrameOutcome { kRendered, kSkipped, kFailed };

struct FrameReport {
    int frame = 0;
    FrameOutcome outcome = FrameOutcome::kRendered;
    std::string path;
    std::string error{};  // of a failed frame: one line
    FrameStatistics statistics{};
};

// The frames of a sequence, in the order asked for; those after an interrupt are missing.
struct SequenceReport {
    std::vector<FrameReport> frames;
    double wall_seconds = 0;
    bool interrupted = false;
};

// Renders the frames and writes them, each encoded and written while the next one renders. A frame
// that fails is reported and the others are rendered all the same. `on_frame` is called from one
// thread at a time, in the order of the frames. Throws InputError where settings do not fit the
// scene.
[[nodiscard]] SequenceReport render_sequence(
    const Scene& scene, const std::vector<int>& frames, const ImageSettings& image,
    const ExecutionSettings& execution, const OutputSettings& output,
    const std::function<void(const FrameReport&)>& on_frame, const std::atomic<bool>& cancelled);

}  // namespace penumbra::renderer
