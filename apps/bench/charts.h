#pragma once

#include <string>
#include <vector>

#include "apps/bench/comparison.h"
#include "apps/bench/report.h"

// The page's drawings, as SVG.

namespace penumbra::bench {

// A bar per pass: its median with the quartiles as whiskers, a mark where its limit is, and the
// fraction in words.
[[nodiscard]] std::string bar_chart(const std::vector<PassResult>& passes,
                                    const std::string& title);

// Curves over the number of threads: the frame, its tile and frame passes, and what would be ideal.
[[nodiscard]] std::string speed_up_chart(const SceneResult& scene);
[[nodiscard]] std::string efficiency_chart(const SceneResult& scene);

// The changes of one scene and number of threads with their intervals, about zero.
[[nodiscard]] std::string change_chart(const std::vector<PassComparison>& passes,
                                       const std::string& title);

}  // namespace penumbra::bench
