#pragma once

#include <string>
#include <vector>

#include "apps/bench/report.h"

// What a launch of the program says about a pass: one number.

namespace penumbra::bench {

// Logarithms of pass / limit, one per launch. Empty where a time is zero, or floors are not known.
using LaunchRatios = std::vector<double>;

// The median of pass / limit of the same repetition.
[[nodiscard]] LaunchRatios median_ratios(const PassResult& pass);
// The floor of the pass over that of the limit of `reference` (floors.h).
[[nodiscard]] LaunchRatios floor_ratios(const PassResult& pass, const PassResult& reference);

struct LaunchValues {
    LaunchRatios then, now;
    LimitKind reference = LimitKind::kNone;  // the limit that they refer to
};

// `values` without the part that goes with `conditions`, of the same launches: values - k
// conditions, where 0 <= k <= 1 explains best (least squares) how launches of the *same* report
// differ. So the adjustment knows nothing of how the reports differ (the analysis of covariance of
// Fisher, "Statistical Methods for Research Workers", 4th edition, 1932).
[[nodiscard]] LaunchValues adjusted(LaunchValues values, const LaunchValues& conditions);

// Of a pass in an old and a new run. Where floors are known, in the steadier of two ways: against
// its own limit, or against the primary rays, adjusted by how much faster streams were than those.
// The former are a mixture of arithmetic and memory that suffers from neighbours as the passes do;
// passes differ in how much memory they need. The steadier way spreads all launches less, old and
// new alike: not knowing which is which, the choice favours neither. Without floors the medians.
[[nodiscard]] LaunchValues steadiest_values(const ThreadRun& then, const ThreadRun& now,
                                            const std::string& pass);

}  // namespace penumbra::bench
