#pragma once

#include <vector>

#include "apps/bench/report.h"

// What a launch of the program says about a pass: one number.

namespace penumbra::bench {

// How the repetitions of a launch become one.
enum class Digest {
    kMedianRatio,  // the median of pass / limit of the same repetition: for what slows the machine
                   // down for longer than a repetition, and so meets both
    kLowDeciles,   // the lowest decile of the pass's times over that of the limit's ...
    kLowest,       // ... or the lowest of each: for disturbances that are shorter and meet one of
                   // them; they make it slower, never quicker
};

// The logarithm of pass / limit of each launch, the limit being that of the pass `reference` in the
// same repetitions. Empty where a time is zero.
[[nodiscard]] std::vector<double> launch_values(const PassResult& pass, const PassResult& reference,
                                                Digest digest);

struct LaunchValues {
    std::vector<double> then, now;
    LimitKind reference = LimitKind::kNone;  // the limit that they refer to
};
// Of a pass in an old and a new run: against its own limit or the primary rays, digested in one of
// the ways above, whichever spreads all launches, old and new alike, least. Not knowing which is
// which, the choice favours neither. The primary rays are a mixture of arithmetic and memory that
// suffers from neighbours as the passes do; a stream or a loop of multiply-adds may not notice
// them.
[[nodiscard]] LaunchValues steadiest_values(const ThreadRun& then, const ThreadRun& now,
                                            const std::string& pass);

}  // namespace penumbra::bench
