#pragma once

#include <functional>
#include <vector>

#include "core/scene/scene.h"

// Which frames a sequence renders, in which order, and what for: a frame may need others that
// nobody asked for, or that are on disk already.

namespace penumbra::renderer {

enum class FrameWork {
    kWrite,
    kHistoryOnly,  // rendered for the frames after it, not written
    kSkip,         // done, and no frame needs it
};

struct PlannedFrame {
    int frame = 0;
    FrameWork work = FrameWork::kWrite;
    // The frame before it in time is rendered right before it: what is kept of that one and of
    // those before still counts. Otherwise the history begins anew.
    bool continues_history = false;

    friend bool operator==(const PlannedFrame&, const PlannedFrame&) = default;
};

// A frame's history is the `history_length` frames before it, as far as they are the animation's:
// the same whatever else is asked for, so that chunks of a sequence are the sequence. Frames before
// the animation have none. Steps and holes are filled with frames that are history only, and so are
// frames that are done where one after them is not.
//
// `frames` are to be written, each once. The plan is in ascending order, or, without history, in
// theirs. `is_done` tells whether a frame needs no writing; it is asked once per frame.
[[nodiscard]] std::vector<PlannedFrame> plan_frames(const std::vector<int>& frames,
                                                    int history_length, const Animation& animation,
                                                    const std::function<bool(int)>& is_done);

}  // namespace penumbra::renderer
