#pragma once

#include <string>
#include <vector>

#include "apps/bench/report.h"

// Repetitions during which nobody else computed on our cores, as core_share.h tells. In the others
// each pass is slower by a factor of its own, and its limit by yet another.

namespace penumbra::bench {

// Of the best share: what the clock's steps and the measurement itself leave.
inline constexpr double kLeastShare = 0.95;
// A launch with fewer undisturbed repetitions (or with fewer at all) says too little.
inline constexpr int kFewestUndisturbed = 3;

// That of cores of our own, if one repetition in ten had them: the upper decile of all repetitions'
// shares. 0 unless the report tells those of all.
[[nodiscard]] double best_core_share(const ThreadRun& run);
// Of that scene's run with so many threads; 0 if there is none.
[[nodiscard]] double best_core_share(const Report& report, const std::string& scene, int threads);

[[nodiscard]] inline bool is_undisturbed(double core_share, double best) {
    return core_share >= kLeastShare * best;
}

// "others used the cores in 3 of 11 frames", or "" where nobody did.
[[nodiscard]] std::string disturbance(const ThreadRun& run);

// The run with its undisturbed repetitions alone, of launches that have enough of them.
[[nodiscard]] ThreadRun undisturbed(const ThreadRun& run, double best);

// The numbers of the launches that a pass, or a run, was measured in, ascending.
[[nodiscard]] std::vector<int> launches(const PassResult& pass);
[[nodiscard]] std::vector<int> launches(const ThreadRun& run);

// The run with the `count` repetitions alone that had the greatest shares, in their order.
[[nodiscard]] ThreadRun least_disturbed(const ThreadRun& run, std::size_t count);

}  // namespace penumbra::bench
