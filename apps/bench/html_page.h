#pragma once

#include <string>

#include "apps/bench/comparison.h"
#include "apps/bench/report.h"

namespace penumbra::bench {

// The report as one page that needs nothing but itself, not even a script: machine, a choice of the
// scene, how its passes scale, and per number of threads bars against the limits and the numbers.
// `comparison` may be null.
[[nodiscard]] std::string html_page(const Report& report, const Comparison* comparison);

}  // namespace penumbra::bench
