#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "apps/bench/report.h"
#include "apps/renderer/settings.h"
#include "core/profile/profile.h"

// Runs the frames and their limits in turns.

namespace penumbra::bench {

struct BenchSettings {
    std::vector<std::string> scenes;  // files; "" is the built-in scene
    int frame = 0;                    // of each scene; 0: its first one
    renderer::ImageSettings image;
    renderer::ExecutionSettings execution;  // threads, profile and observer are the bench's own
    std::vector<int> threads;               // one run each
    int warmups = 2;
    int repetitions = 11;
    // Each run waits at most so long, and measures more repetitions, for as many as asked for
    // during which nobody else computed on its cores (core_share.h); those that were disturbed
    // least count.
    double patience_seconds = 0;
    // The first one's calls of limits are taken that has them, the best one's core shares.
    std::vector<const Report*> calls_of;
};

// The last repetition of each run, one after the other, as slices for a trace.
struct Recording {
    profile::Profile profile;
    std::deque<std::string> names;  // of the runs, which the slices point to
};

// What is told while it goes on: "sponza, 2 threads: 3 of 11".
using Listener = std::function<void(const std::string& line)>;

// Where `cancelled` becomes true it returns early, with the runs that were finished. `recording`
// may be null.
[[nodiscard]] Report measure(const BenchSettings& settings, const Listener& listener,
                             const std::atomic<bool>& cancelled, Recording* recording);

}  // namespace penumbra::bench
