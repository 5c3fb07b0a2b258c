#pragma once

#include <cstdint>
#include <span>

// Errors of single values: what needs no neighbours.
//
// The metrics stand in core although apps/diff is the only one of our programs that asks for them:
// they are formulas of the installed library, for programs and measurements that have pictures and
// want no report. How a comparison of files goes about them is apps/diff's alone.

namespace penumbra::compare {

// Sums over values; blocks of an image are added in a fixed order, so that the totals do not depend
// on threads.
struct ErrorSums {
    std::uint64_t values = 0;
    double largest = 0;
    double absolute = 0;          // |a - b|
    double squared = 0;           // (a - b)^2
    double relative_squared = 0;  // (a - b)^2 / (b^2 + 0.01), b the reference

    void add(double reference, double test);
    void add(const ErrorSums& block);

    // Means over the values; 0 where there are none.
    [[nodiscard]] double mae() const;
    [[nodiscard]] double rmse() const;
    [[nodiscard]] double relmse() const;
    // 10 log10(1 / mean squared error), for values whose peak is 1; infinite where all are equal.
    [[nodiscard]] double psnr() const;
};

}  // namespace penumbra::compare
