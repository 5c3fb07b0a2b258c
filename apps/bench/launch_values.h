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

// The logarithm of pass / limit of each launch. Empty where a time is zero.
[[nodiscard]] std::vector<double> launch_values(const PassResult& pass, Digest digest);

struct LaunchValues {
    std::vector<double> then, now;
};
// Of the same pass in an old and a new run, both digested in the way that spreads all of them, old
// and new alike, least. Not knowing which is which, the choice favours neither.
[[nodiscard]] LaunchValues steadiest_values(const PassResult& then, const PassResult& now);

}  // namespace penumbra::bench
