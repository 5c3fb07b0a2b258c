#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/bench/launch_values.h"
#include "apps/bench/relabelling.h"
#include "apps/bench/report.h"

namespace penumbra::bench {

// A run of an old report and the same of a new one, as they are compared: by their undisturbed
// repetitions alone where both have enough launches with such, else by all.
struct MatchedRuns {
    struct Side {
        ThreadRun kept;
        std::vector<std::size_t> places;  // of the launches kept, among all
        std::size_t all = 0;              // launches
    };
    Side then, now;
    std::string note;  // how many launches were disturbed, in words; empty if none was

    // Values of the launches kept, each in its place.
    [[nodiscard]] Quantity among_all(const LaunchValues& values) const;
};

// Shares of another processor's cores mean something else.
[[nodiscard]] MatchedRuns match(const ThreadRun& then, const ThreadRun& now,
                                bool is_same_processor);

}  // namespace penumbra::bench
