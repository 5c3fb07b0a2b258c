#include <doctest/doctest.h>

#include <string>
#include <thread>
#include <vector>

#include "core/parallel/arena.h"
#include "core/profile/timeline.h"

namespace penumbra::profile {
namespace {

Slice slice(const char* name, Nanoseconds begin, Nanoseconds end, Kind kind = Kind::kPhase) {
    return {.name = name, .begin = begin, .end = end, .kind = kind};
}

// "frame@0-100 loop@10-60 idle@10-20", indented by depth.
std::vector<std::string> told(const Timeline& timeline) {
    std::vector<std::string> lines;
    for (const Timeline::Entry& e : timeline.entries)
        lines.push_back(std::string(static_cast<std::size_t>(e.depth), ' ') + e.slice.name +
                        (e.is_idle ? "! " : " ") + std::to_string(e.slice.begin) + "-" +
                        std::to_string(e.slice.end));
    return lines;
}

// What a thread's outermost slices add up to.
Nanoseconds outermost_sum(const Timeline& timeline) {
    Nanoseconds sum = 0;
    for (const Timeline::Entry& e : timeline.entries)
        if (e.depth == 0) sum += e.slice.end - e.slice.begin;
    return sum;
}

void spin(int rounds) {
    for (volatile int i = 0; i < rounds;) i = i + 1;
}

}  // namespace

TEST_CASE("gaps become idle slices: on a thread without work, and where a loop waits") {
    Profile profile;
    profile.make_tracks(2);
    // In the order in which slices end.
    profile.track(0).add(slice("task", 20, 40, Kind::kTask));
    profile.track(0).add(slice("loop", 10, 60, Kind::kLoop));
    profile.track(0).add(slice("frame", 0, 100));
    profile.track(1).add(slice("task", 12, 55, Kind::kTask));
    const std::vector<Timeline> threads = timelines(profile);
    REQUIRE(threads.size() == 2);
    CHECK(told(threads[0]) == std::vector<std::string>{"frame 0-100", " loop 10-60",
                                                       "  idle! 10-20", "  task 20-40",
                                                       "  idle! 40-60"});
    CHECK(told(threads[1]) == std::vector<std::string>{"idle! 0-12", "task 12-55", "idle! 55-100"});
}

TEST_CASE("slices of equal times keep their order: the one that ended last holds the others") {
    Profile profile;
    profile.make_tracks(1);
    profile.track(0).add(slice("inner", 5, 9));
    profile.track(0).add(slice("outer", 5, 9));
    profile.track(0).add(slice("next", 9, 9));
    const std::vector<Timeline> threads = timelines(profile);
    CHECK(told(threads[0]) == std::vector<std::string>{"outer 5-9", " inner 5-9", "next 9-9"});
}

TEST_CASE("an empty profile has no timelines, an idle thread one long gap") {
    Profile profile;
    CHECK(timelines(profile).empty());
    profile.make_tracks(2);
    CHECK(timelines(profile).empty());
    profile.track(0).add(slice("frame", 3, 8));
    CHECK(told(timelines(profile)[1]) == std::vector<std::string>{"idle! 3-8"});
}

TEST_CASE("totals add up all threads, by kind and name") {
    Profile profile;
    profile.make_tracks(2);
    profile.track(0).add(slice("noise", 0, 5, Kind::kTask));
    profile.track(1).add(slice("noise", 2, 9, Kind::kTask));
    profile.track(0).add(slice("noise", 0, 9, Kind::kPhase));
    CHECK(total(profile, Kind::kTask, "noise") == 12);
    CHECK(total(profile, Kind::kPhase, "noise") == 9);
    CHECK(total(profile, Kind::kPass, "noise") == 0);
}

TEST_CASE("a full track counts what it drops, and make_room gives room again") {
    Profile profile(2, 5);
    profile.make_tracks(1);
    for (int i = 0; i < 3; ++i) profile.track(0).add(slice("s", i, i + 1));
    CHECK(profile.track(0).slices().size() == 2);
    CHECK(profile.dropped() == 1);
    for (int round = 0; round < 4; ++round) {
        profile.make_room();
        for (int i = 0; i < 3; ++i) profile.track(0).add(slice("s", i, i + 1));
    }
    CHECK(profile.track(0).slices().size() == 5);
    CHECK(profile.dropped() == 10);
    profile.clear();
    CHECK(profile.dropped() == 0);
    CHECK(profile.track(0).slices().empty());
}

TEST_CASE("an arena records its loops and each of their tasks, on every worker's track") {
    Profile profile;
    parallel::Arena arena(3);
    arena.record(&profile);
    {
        const Phase whole(&profile, "whole");
        arena.for_each(200, [](int, int) { spin(20000); });
        {
            const Phase inner(&profile, "inner");
            arena.for_each(50, [](int, int) { spin(20000); });
        }
        CHECK(std::string(profile.phase()) == "whole");
    }
    int tasks = 0;
    int inner_tasks = 0;
    for (int worker = 0; worker < 3; ++worker)
        for (const Slice& s : profile.track(worker).slices()) {
            tasks += s.kind == Kind::kTask;
            inner_tasks += s.kind == Kind::kTask && std::string(s.name) == "inner";
        }
    CHECK(tasks == 250);
    CHECK(inner_tasks == 50);
    for (const Timeline& timeline : timelines(profile))
        CHECK(outermost_sum(timeline) == timeline.end - timeline.begin);
}

TEST_CASE("nothing is recorded without a profile, and after it was taken away") {
    Profile profile;
    parallel::Arena arena(2);
    arena.record(&profile);
    arena.record(nullptr);
    arena.for_each(10, [](int, int) {});
    const Phase phase(nullptr, "nowhere");
    const Scope scope(nullptr, 0, Kind::kPass, "nothing");
    CHECK(profile.track(0).slices().empty());
    CHECK(profile.track(1).slices().empty());
}

}  // namespace penumbra::profile
