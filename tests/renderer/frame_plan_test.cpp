#include "apps/renderer/frame_plan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "apps/renderer/frame_list.h"

using namespace penumbra;
using namespace penumbra::renderer;

namespace {

constexpr Animation kAnimation{.first_frame = 1, .last_frame = 48};

std::vector<PlannedFrame> plan_of_list(const char* frames, int history_length,
                                       const std::set<int>& done = {}) {
    return plan_frames(parse_frame_list(frames), history_length, kAnimation,
                       [&](int frame) { return done.contains(frame); });
}

// "3h+4w": frame 3 is history only, and 4, which continues it, is written; "s" is skipped.
std::string text_of_plan(const std::vector<PlannedFrame>& plan) {
    std::string text;
    for (const PlannedFrame& planned : plan) {
        if (!text.empty()) text += planned.continues_history ? "+" : " ";
        text += std::to_string(planned.frame) + "whs"[static_cast<int>(planned.work)];
    }
    return text;
}
std::string planned(const char* frames, int history_length, const std::set<int>& done = {}) {
    return text_of_plan(plan_of_list(frames, history_length, done));
}

// What each written frame finds of the frames before it, where the newest `length` are kept.
std::map<int, std::vector<int>> histories(const std::vector<PlannedFrame>& plan,
                                          std::size_t length) {
    std::map<int, std::vector<int>> found;
    std::vector<int> kept;
    for (const PlannedFrame& planned : plan) {
        if (planned.work == FrameWork::kSkip) continue;
        if (!planned.continues_history) kept.clear();
        if (planned.work == FrameWork::kWrite) found[planned.frame] = kept;
        kept.push_back(planned.frame);
        if (kept.size() > length) kept.erase(kept.begin());
    }
    return found;
}

}  // namespace

TEST_CASE("without history frames are written in the order asked for, or skipped where done") {
    CHECK(planned("5,9,2-3", 0) == "5w 9w 2w 3w");
    CHECK(planned("5,9,2-3", 0, {9, 3, 4}) == "5w 9s 2w 3s");
}

TEST_CASE("frames before those asked for are history only, as far as the animation goes") {
    CHECK(planned("10-11", 3) == "7h+8h+9h+10w+11w");
    CHECK(planned("1-3", 3) == "1w+2w+3w");
    CHECK(planned("3", 8) == "1h+2h+3w");
    CHECK(planned("50", 1) == "49h+50w");
}

TEST_CASE("frames before the animation have no history and are none") {
    CHECK(planned("-1-2", 3) == "-1w 0w 1w+2w");
    CHECK(planned("2", 3) == "1h+2w");
}

TEST_CASE("ranges apart begin a history of their own, ranges close by share one") {
    CHECK(planned("4,20-21", 2) == "2h+3h+4w 18h+19h+20w+21w");
    CHECK(planned("4,6-7", 3) == "1h+2h+3h+4w+5h+6w+7w");
    CHECK(planned("20-21,4", 2) == planned("4,20-21", 2));
}

TEST_CASE("steps are filled up to the history's length") {
    CHECK(planned("1-10x3", 2) == "1w+2h+3h+4w+5h+6h+7w+8h+9h+10w");
    CHECK(planned("1-11x5", 2) == "1w 4h+5h+6w 9h+10h+11w");
}

TEST_CASE("what is done is rendered again only where a frame needs it as history") {
    CHECK(planned("1-8", 2, {1, 2, 3, 4, 6, 7, 8}) == "1s 2s 3h+4h+5w 6s 7s 8s");
    CHECK(planned("1-6", 1, {2, 4, 5}) == "1w+2h+3w 4s 5h+6w");
    CHECK(planned("1-3", 2, {1, 2, 3}) == "1s 2s 3s");
}

TEST_CASE("each written frame finds the frames before it, whatever else is asked for") {
    for (const int length : {1, 2, 3, 7, 100}) {
        for (const char* list : {"1-48", "5-8", "1-48x5", "40-48,3,1-2", "8-9,12,20-30x4"}) {
            for (const std::set<int>& done : {std::set<int>{}, {2, 3, 8}, {1, 5, 41, 44, 47}}) {
                CAPTURE(length);
                CAPTURE(list);
                const auto plan = plan_of_list(list, length, done);
                for (const auto& [frame, history] :
                     histories(plan, static_cast<std::size_t>(length))) {
                    std::vector<int> expected;
                    for (int f = std::max(1, frame - length); f < frame; ++f) expected.push_back(f);
                    CHECK(history == expected);
                }
            }
        }
    }
}

TEST_CASE("a plan holds every frame once, in ascending order, and writes all that is not done") {
    const std::set<int> done{3, 21, 40};
    const auto plan = plan_of_list("40-44,1-9x2,20-22", 4, done);
    CHECK(std::ranges::is_sorted(plan, std::ranges::less_equal{}, &PlannedFrame::frame));
    std::vector<int> written;
    for (const PlannedFrame& planned : plan)
        if (planned.work == FrameWork::kWrite) written.push_back(planned.frame);
    CHECK(written == std::vector<int>{1, 5, 7, 9, 20, 22, 41, 42, 43, 44});
}

TEST_CASE("the last frames there are have a history, the first ones none") {
    constexpr int kLow = std::numeric_limits<int>::min();
    constexpr int kHigh = std::numeric_limits<int>::max();
    const Animation all{.first_frame = kLow, .last_frame = kHigh};
    const auto plan = plan_frames({kLow, kHigh}, 1, all, [](int) { return false; });
    CHECK(plan == std::vector<PlannedFrame>{{.frame = kLow},
                                            {kHigh - 1, FrameWork::kHistoryOnly},
                                            {kHigh, FrameWork::kWrite, true}});
    CHECK(plan_frames({kLow + 1}, kHigh, all, [](int) { return false; }).size() == 2);
}
