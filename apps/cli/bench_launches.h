#pragma once

#include <atomic>

#include "apps/bench/measure.h"
#include "apps/cli/bench_options.h"

namespace penumbra::cli {

// Measures in so many launches of this program, one after the other, and puts their repetitions
// together. What follows the first takes its limits' calls, so that all measure the same. The trace
// is the last one's, which writes it itself. Throws InputError after the first one if it has
// nothing in common with `old`, a report or null. Where `cancelled` becomes true it returns early.
[[nodiscard]] bench::Report measure_in_launches(const BenchOptions& options, int launches,
                                                const bench::Report* old,
                                                const bench::Listener& listener,
                                                const std::atomic<bool>& cancelled);

}  // namespace penumbra::cli
