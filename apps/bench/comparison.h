#pragma once

#include <string>
#include <vector>

#include "apps/bench/report.h"

// What got slower between two reports, with confidence. docs/bench-compare.md explains the method
// and what it was measured to find.

namespace penumbra::bench {

// A launch of the program is one observation: what happens to one of its frames happens to the
// others as well (where its memory lies, who its neighbours are).
inline constexpr int kFewestLaunches = 5;
// At most this often anything at all is reported where nothing has changed.
inline constexpr double kFalseAlarms = 0.01;
// And the rank test of the pass alone must refute at this level that nothing changed.
inline constexpr double kRankLevel = 0.05;
inline constexpr double kIntervalConfidence = 0.95;
// A smaller change is not reported, however certain: not even the same program keeps its fractions
// closer than that from one hour to the next.
inline constexpr double kLeastChange = 0.02;

// Nor is one below so many times what two launches of the same program typically differ by: the
// neighbours of one hour are not those of another.
inline constexpr double kLeastStrength = 3;

enum class Verdict { kNoChange, kSlower, kFaster };
[[nodiscard]] std::string name(Verdict verdict);  // "", "SLOWER", "faster"

struct PassComparison {
    std::string scene;
    int threads = 0;
    std::string pass;
    double old_fraction = 0, new_fraction = 0;  // of its limit, medians over all repetitions
    LimitKind reference = LimitKind::kNone;     // the limit that the change refers to
    // Of the pass's time where the limit's stays the same, 0.05 is 5 % slower: the estimate and its
    // interval.
    double change = 0, low = 0, high = 0;
    double rank_probability = 1;  // of Mann and Whitney's test, for this pass alone
    double probability = 1;       // corrected for the number of passes
    double strength = 0;          // of the change, in differences between launches of one report
    Verdict verdict = Verdict::kNoChange;
};

struct Comparison {
    int old_launches = 0, new_launches = 0;
    std::vector<std::string> differences;  // of machines, settings and load, in words
    std::vector<std::string> left_out;     // what could not be compared, and why
    std::vector<PassComparison> passes;
    double least_probability = 0;  // that so many launches can show; above kFalseAlarms: nothing
};

// Throws InputError unless all passes of the report were measured in at least kFewestLaunches, as
// many each; returns how many. `which` names the report in the message.
int require_launches(const Report& report, const std::string& which);

// Throws InputError unless a scene of the same work was measured in both on as many threads: before
// all launches of the new report are measured in vain.
void require_common(const Report& old_report, const Report& new_report);

// Compares what is in both. Throws InputError if a report has too few launches, or nothing can be
// compared.
[[nodiscard]] Comparison compare(const Report& old_report, const Report& new_report);

// Those that are slower, by more than so many percent.
[[nodiscard]] std::vector<PassComparison> slower_beyond(const Comparison& comparison,
                                                        double percent);

[[nodiscard]] std::string comparison_table(const Comparison& comparison);

}  // namespace penumbra::bench
