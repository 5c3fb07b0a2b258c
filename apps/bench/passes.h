#pragma once

#include "apps/bench/floors.h"
#include "apps/bench/limits.h"
#include "apps/bench/report.h"
#include "apps/renderer/frame_statistics.h"

// What a repetition's raw times mean for each pass of a run.

namespace penumbra::bench {

// A run without samples: the frame's passes in their order, what lies between them, groups, and the
// frame itself.
[[nodiscard]] ThreadRun empty_run(int threads, const Workload& work, const Limits& limits);

// One repetition: a frame's times, `profile` that recorded it, and the limits beside it.
void add_samples(const renderer::FrameStatistics& frame, const profile::Profile& profile,
                 const Limits::Measured& limits, double core_share, ThreadRun& run);

// What all repetitions of a launch tell together, into its samples.
void set_floors(const Floors& floors, const Limits::Measured& limits, ThreadRun& run);

}  // namespace penumbra::bench
