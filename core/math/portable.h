#pragma once

// Elementary functions of doubles made of additions, multiplications, divisions and roots alone,
// which IEEE 754 defines to the last bit: the same results with every C library and on every
// processor. For what is computed once per scene, frame or vertex and reaches the pixels; the C
// library's own functions differ between its versions, and between processors with and without
// fused multiply-add. Within 4 units in the last place, or 2^-52 of the largest value near zeros.

namespace penumbra::portable {

[[nodiscard]] double sin(double x);  // radians
[[nodiscard]] double cos(double x);
[[nodiscard]] double tan(double x);
[[nodiscard]] double atan2(double y, double x);  // in [-pi, pi]
[[nodiscard]] double acos(double x);             // |x| > 1 counts as the nearer of -1 and 1

}  // namespace penumbra::portable
