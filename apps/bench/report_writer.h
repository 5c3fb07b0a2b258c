#pragma once

#include <string>

#include "apps/bench/comparison.h"
#include "apps/bench/report.h"

namespace penumbra::bench {

// The report in Google Benchmark's JSON format, so that its compare.py reads it: one entry per
// repetition and pass, then their mean, median, standard deviation and coefficient of variation.
// Further keys hold what that format has no place for; docs/bench.md lists them. read_report()
// reads it back. `comparison` may be null.
[[nodiscard]] std::string benchmark_json(const Report& report,
                                         const Comparison* comparison = nullptr);

}  // namespace penumbra::bench
