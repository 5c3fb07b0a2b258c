#include "apps/renderer/sequence.h"

#include <doctest/doctest.h>

#include "tests/check/folder.h"
#include "tests/renderer/support.h"

using namespace penumbra;
using namespace penumbra::tests;
using renderer::FrameOutcome;
using renderer::FrameReport;

namespace {

// Frames 2, 1 and 3, in this order, into the folder.
renderer::SequenceReport render_three(const Folder& folder,
                                      const std::function<void(const FrameReport&)>& on_frame) {
    static const Scene scene = read_scene(data_scene("cubes/cubes-small.json"));
    const std::atomic<bool> cancelled = false;
    return renderer::render_sequence(scene, {2, 1, 3}, {.width = 32, .height = 32}, {.threads = 1},
                                     {.pattern = folder / "#.exr", .resume = true}, on_frame,
                                     cancelled);
}

std::vector<std::pair<int, FrameOutcome>> outcomes(const renderer::SequenceReport& report) {
    std::vector<std::pair<int, FrameOutcome>> all;
    for (const FrameReport& frame : report.frames) all.emplace_back(frame.frame, frame.outcome);
    return all;
}

}  // namespace

TEST_CASE("frames are rendered in the order asked for, and skipped where they are done") {
    using enum FrameOutcome;
    const Folder folder;
    CHECK(
        outcomes(render_three(folder, {})) ==
        std::vector<std::pair<int, FrameOutcome>>{{2, kRendered}, {1, kRendered}, {3, kRendered}});
    std::filesystem::remove(folder / "1.exr");
    CHECK(outcomes(render_three(folder, {})) ==
          std::vector<std::pair<int, FrameOutcome>>{{2, kSkipped}, {1, kRendered}, {3, kSkipped}});
}

TEST_CASE("a frame that another process has written in the meantime is skipped") {
    using enum FrameOutcome;
    const Folder others, ours;
    static_cast<void>(render_three(others, {}));
    const auto report = render_three(ours, [&](const FrameReport& frame) {
        if (frame.frame == 2) std::filesystem::copy_file(others / "3.exr", ours / "3.exr");
    });
    CHECK(outcomes(report) ==
          std::vector<std::pair<int, FrameOutcome>>{{2, kRendered}, {1, kRendered}, {3, kSkipped}});
}
