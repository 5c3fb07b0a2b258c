#pragma once

#include <string_view>
#include <vector>

#include "core/profile/profile.h"

// What becomes of the recorded slices: whole timelines, and sums.

namespace penumbra::profile {

// One thread's slices in the order in which they begin, outer ones before inner ones. Slices nest:
// two of them are apart, or one holds the other.
struct Timeline {
    struct Entry {
        Slice slice;
        bool is_idle = false;  // a gap: the thread had nothing to do
        int depth = 0;         // how many slices hold it
    };
    std::vector<Entry> entries;
    Nanoseconds begin = 0, end = 0;  // of the whole profile: the same for all threads
};

// The timelines of all threads. Where a thread has no slice at all, and where it waits within a
// parallel loop, an idle one is put, so that each thread's outermost slices add up to the whole.
[[nodiscard]] std::vector<Timeline> timelines(const Profile& profile);

// The time of all threads together in slices of this name and kind.
[[nodiscard]] Nanoseconds total(const Profile& profile, Kind kind, std::string_view name);

}  // namespace penumbra::profile
