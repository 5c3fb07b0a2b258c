#pragma once

#include "core/simd/lanes.h"

// Sums of products of doubles without any rounding: Shewchuk, "Adaptive Precision Floating-Point
// Arithmetic and Fast Robust Geometric Predicates" (1997), section 2.

namespace penumbra::shadow {

// value + error is the exact result, value the rounded one.
struct WithError {
    double value, error;
};

// Knuth; Shewchuk's theorem 7.
inline WithError exact_add(double a, double b) {
    const double sum = a + b;
    const double b_virtual = sum - a;
    const double a_virtual = sum - b_virtual;
    return {sum, (a - a_virtual) + (b - b_virtual)};
}

inline WithError exact_multiply(double a, double b) {
    const double product = a * b;
    return {product, simd::fma(a, b, -product)};
}

// Holds as many additions as the largest of our predicates makes: a determinant of 6 products of 3
// factors of 2 doubles, 4 doubles each, and a limit times 3 such, 8 doubles each. Exact for
// products of up to four floats of any size: those are multiples of 2^-596, far above the doubles'
// smallest.
class ExactSum {
  public:
    void add(double x) {
        int kept = 0;  // zeros are left out; the others do not overlap and grow in magnitude
        for (int i = 0; i < count_; ++i) {
            const WithError sum = exact_add(x, terms_[i]);
            if (sum.error != 0) terms_[kept++] = sum.error;
            x = sum.value;
        }
        if (x != 0) terms_[kept++] = x;
        count_ = kept;
    }

    template <class... Factors>
    void add_product(double a, double b, Factors... others) {
        const WithError product = exact_multiply(a, b);
        add_factor(product.value, others...);
        if (product.error != 0) add_factor(product.error, others...);
    }

    // Of the sum: -1, 0 or 1. Sums of what is not finite count as 0.
    [[nodiscard]] int sign() const {
        const double largest = count_ == 0 ? 0 : terms_[count_ - 1];
        return (largest > 0) - (largest < 0);
    }

  private:
    void add_factor(double a) { add(a); }
    template <class... Factors>
    void add_factor(double a, Factors... others) {
        add_product(a, others...);
    }

    static constexpr int kCapacity = 6 * 8 * 4 + 3 * 6 * 4 * 8;
    double terms_[kCapacity];
    int count_ = 0;
};

}  // namespace penumbra::shadow
