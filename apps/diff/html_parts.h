#pragma once

#include <string>
#include <string_view>

#include "apps/diff/report.h"

// The pieces that reports about pairs of images are made of; see apps/page for those of any report.

namespace penumbra::diff {

// The page up to its heading, style sheet included, and from the script to the end.
[[nodiscard]] std::string html_begin(std::string_view title);
[[nodiscard]] std::string html_end();

// The pair's failures as a list, its metrics as a table: "" where there are none.
[[nodiscard]] std::string html_failures(const PairReport& pair);
[[nodiscard]] std::string html_metrics(const PairReport& pair);

// A viewer per layer that has pictures, with flip, blink, slider, side by side, error map, zoom and
// the worst tiles; above them the choice of the layer. They belong in a <section> of their own.
[[nodiscard]] std::string html_viewers(const PairReport& pair);

}  // namespace penumbra::diff
