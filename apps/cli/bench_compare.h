#pragma once

#include <optional>

#include "apps/bench/comparison.h"
#include "apps/cli/bench_options.h"

namespace penumbra::cli {

// The report that `--compare` names, if it does. Throws InputError where it has too few launches to
// compare with.
[[nodiscard]] std::optional<bench::Report> read_old_report(const BenchOptions& options);

// 1 if a pass is slower by more than `--fail-slower` allows, which is then said on stderr; else 0.
[[nodiscard]] int judge(const bench::Comparison& comparison, const BenchOptions& options);

}  // namespace penumbra::cli
