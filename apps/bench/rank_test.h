#pragma once

#include <span>
#include <vector>

// Tests and estimates that assume nothing about how the values are distributed: timings have heavy
// tails.

namespace penumbra::bench {

// Mann and Whitney, "On a Test of Whether one of Two Random Variables is Stochastically Larger than
// the Other" (1947). The probability is that of a statistic at least as far from its mean, to
// either side, if all values came from one distribution.
struct RankTest {
    double statistic = 0;    // pairs (a, b) with b > a; equal ones count one half
    double probability = 1;  // two-sided
    bool is_exact = false;   // else the normal approximation
};
// Exact for up to kMostExact values together, ties included: the distribution over all ways to deal
// the values (with mid-ranks; Streitberg and Roehmel 1986). Beyond that the normal approximation,
// corrected for ties and continuity. Both at least one value.
inline constexpr int kMostExact = 64;
[[nodiscard]] RankTest mann_whitney(std::span<const double> a, std::span<const double> b);

// How much larger b is than a: the median of all differences b - a (Hodges and Lehmann 1963), with
// the interval that the rank test does not refute.
struct Shift {
    double estimate = 0, low = 0, high = 0;
};
// `confidence` in (0, 1). Where there are too few values for it, the interval is infinite.
[[nodiscard]] Shift hodges_lehmann(std::span<const double> a, std::span<const double> b,
                                   double confidence);

}  // namespace penumbra::bench
