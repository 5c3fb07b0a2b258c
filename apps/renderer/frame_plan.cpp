#include "apps/renderer/frame_plan.h"

#include <algorithm>
#include <map>

namespace penumbra::renderer {
namespace {

using WorkOfFrames = std::map<int, FrameWork>;

int first_of_history(int frame, int length, const Animation& animation) {
    const long long first = static_cast<long long>(frame) - length;  // may be below all int
    return static_cast<int>(std::max<long long>(first, animation.first_frame));
}

// Adds what the frames to be written look back on.
void add_history(const std::vector<int>& written, int length, const Animation& animation,
                 WorkOfFrames& work) {
    for (const int frame : written) {
        for (int f = frame; f > first_of_history(frame, length, animation);) {
            FrameWork& before = work.try_emplace(--f, FrameWork::kSkip).first->second;
            // Written: what else is needed before it is in its own history.
            if (before == FrameWork::kWrite) break;
            before = FrameWork::kHistoryOnly;
        }
    }
}

}  // namespace

std::vector<PlannedFrame> plan_frames(const std::vector<int>& frames, int history_length,
                                      const Animation& animation,
                                      const std::function<bool(int)>& is_done) {
    std::vector<PlannedFrame> plan;
    WorkOfFrames work;
    std::vector<int> written;
    for (const int frame : frames) {
        const bool done = is_done(frame);
        plan.push_back({.frame = frame, .work = done ? FrameWork::kSkip : FrameWork::kWrite});
        work.emplace(frame, plan.back().work);
        if (!done) written.push_back(frame);
    }
    if (history_length == 0) return plan;

    add_history(written, history_length, animation, work);
    plan.clear();
    for (const auto& [frame, its_work] : work) {
        const bool continues = its_work != FrameWork::kSkip && frame > animation.first_frame &&
                               !plan.empty() && plan.back().work != FrameWork::kSkip &&
                               plan.back().frame == frame - 1;
        plan.push_back({.frame = frame, .work = its_work, .continues_history = continues});
    }
    return plan;
}

}  // namespace penumbra::renderer
