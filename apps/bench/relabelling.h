#pragma once

#include <cstddef>
#include <limits>
#include <vector>

// Probabilities for many comparisons at once.

namespace penumbra::bench {

// What was measured of one quantity: `old_count` values of old launches, then those of new ones.
// All quantities of a comparison come from the same launches, in the same order; kMissing stands
// where a launch says nothing of one.
using Quantity = std::vector<double>;
inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

// How strong a shift is: the median difference between old and new over the median difference
// within them. That is Hodges and Lehmann's shift on a scale that a disturbed launch does not move.
[[nodiscard]] double shift_strength(const Quantity& quantity, std::size_t old_count);

// For each quantity the probability that, if nothing had changed anywhere, *any* of them would show
// a shift as strong as this one does: corrected for their number, and as sharp as their correlation
// allows (Westfall and Young, "Resampling-Based Multiple Testing" (1993), single-step max T). If
// nothing changed, old and new are mere labels of the launches; so the labels are dealt again in
// all ways, or in many random ones (the same in each call) where there are too many.
//
// Ranks alone would not do: five launches against five have 252 labellings, and in 2 of them any
// one of the quantities separates completely.
[[nodiscard]] std::vector<double> corrected_probabilities(const std::vector<Quantity>& quantities,
                                                          std::size_t old_count);

// The least that function can return for that many launches.
[[nodiscard]] double least_probability(std::size_t old_count, std::size_t new_count);

}  // namespace penumbra::bench
