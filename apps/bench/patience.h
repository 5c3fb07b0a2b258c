#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "core/parallel/arena.h"
#include "core/profile/stopwatch.h"

namespace penumbra::bench {

// How long a run waits for cores of its own, and how often it repeats.
class Patience {
  public:
    struct Settings {
        int repetitions = 1;    // at least 1: so many are needed
        double seconds = 0;     // that may be spent beyond those of so many repetitions
        double best_share = 0;  // a share that is known to be that of cores of our own; 0: none is
    };
    // `arena` must outlive it.
    Patience(const Settings& settings, const parallel::Arena& arena);

    // Until enough repetitions were undisturbed, or there are enough and patience has an end.
    [[nodiscard]] bool wants_more() const;
    // Returns once nobody else computes on our cores, patience ends, or it is cancelled.
    void wait(const std::atomic<bool>& cancelled);
    // The share of a repetition that was measured.
    void add(double core_share);

    [[nodiscard]] int count() const { return static_cast<int>(shares_.size()); }
    [[nodiscard]] std::string progress() const;  // "3 of 11", "3 of 11, 2 more were disturbed"

  private:
    [[nodiscard]] int undisturbed() const;

    Settings settings_;
    const parallel::Arena& arena_;
    std::vector<double> shares_;
    double spent_ = 0;               // seconds
    profile::Stopwatch repetition_;  // that goes on
};

}  // namespace penumbra::bench
