#pragma once

#include <string>

#include "apps/bench/report.h"

namespace penumbra::bench {

// One line per scene, number of threads and pass, with medians and quartiles; docs/bench.md lists
// the columns. Cells without a value are empty.
[[nodiscard]] std::string csv(const Report& report);

}  // namespace penumbra::bench
