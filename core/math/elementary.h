#pragma once

#include <limits>
#include <type_traits>

#include "core/simd/lanes.h"

// Elementary functions over the lane type F: float and simd::Float give the same bits for each lane
// count and on every processor; double forwards to the standard library (for tests). Errors are
// against the exact value, in units of the last place of the float result (ulp), and are pinned by
// tests/core/elementary_test.cpp. They hold with denormals flushed, as everywhere in this program.
// NaN gives NaN; the sign of a NaN is unspecified.
//
//   function          error                   domain and special values
//   sin, cos, sincos  2 ulp or 2^-26 absolute |x| <= 2^17; beyond: some value in [-1, 1]; inf: NaN;
//                                             sin(-0) is +0
//   sincos_two_pi     2 ulp or 2^-24 absolute of 2 pi x, any finite x; +-inf: NaN
//   acos              1.5 ulp                 |x| > 1 counts as the nearer of -1 and 1
//   atan, atan2       2 ulp                   signed zeros and infinities as in IEEE 754
//   exp2              1 ulp                   x >= 128: inf; x < -126: 0
//   exp               1.5 ulp                 x > 88.72283: inf; x < -87.33654: 0
//   log2, log         1.5 ulp                 0 <= x < 2^-126, and -0: -inf; x < 0: NaN; inf: inf
//   pow               2^-22 (1 + |y log2 x|)  relative; x < 0: NaN; x^0 = 1^y = 1
//
// The polynomials are minimax fits of our own (Remez exchange in 40 digits, then rounded to float);
// each comment gives the interval and the largest relative error of the unrounded fit.

namespace penumbra {

namespace elementary {

// c0 + x (c1 + x (c2 + ...)), fused.
template <class F>
F polynomial(F, float c0) {
    return F(c0);
}
template <class F, class... Rest>
F polynomial(F x, float c0, Rest... rest) {
    return simd::fma(x, polynomial(x, rest...), F(c0));
}

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kSmallestNormal = 0x1p-126f;

// pi/2, pi and ln 2 as sums of floats, each the rounded rest.
inline constexpr float kHalfPi = 0x1.921fb6p+0f;
inline constexpr float kHalfPiLow = -0x1.777a5cp-25f;
inline constexpr float kPi = 0x1.921fb6p+1f;
inline constexpr float kPiLow = -0x1.777a5cp-24f;
inline constexpr float kLn2 = 0x1.62e43p-1f;
inline constexpr float kLn2Low = -0x1.05c61p-29f;

template <class F>
inline constexpr bool kIsDouble = std::is_same_v<F, double>;

// `magnitude` with its sign flipped where bit 1 of `quadrant` is set.
template <class F>
F flip_by_bit_1(F magnitude, simd::UintOf<F> quadrant) {
    using U = simd::UintOf<F>;
    return simd::as_float(simd::as_uint(magnitude) ^ ((quadrant & U(2u)) << 30));
}

// sine(r + quadrant pi/2) and its cosine, for |r| <= 0.8: pi/4, and the rounding of far quadrants.
template <class F>
void sincos_of_quadrant(F r, simd::UintOf<F> quadrant, F& sine, F& cosine) {
    using U = simd::UintOf<F>;
    const F t = r * r;
    // sin r = r + r t P(t), |r| <= 0.8: 6e-12.
    const F s = simd::fma(
        r * t, polynomial(t, -0.166666672f, 0.00833332911f, -0.000198391877f, 2.7169167e-06f), r);
    // cos r = 1 - t/2 + t t P(t), |r| <= 0.8: 1.4e-10.
    const F c = simd::fma(t * t, polynomial(t, 0.0416666418f, -0.00138871942f, 2.44191961e-05f),
                          simd::fma(t, F(-0.5f), F(1)));
    const auto odd = (quadrant & U(1u)) != U(0u);
    sine = flip_by_bit_1(simd::select(odd, c, s), quadrant);
    cosine = flip_by_bit_1(simd::select(odd, s, c), quadrant + U(1u));
}

// (asin(x) - x) / x^3 as a function of t = x x, |x| <= 1/2: 5e-9 of asin(x).
template <class F>
F asin_tail(F t) {
    return polynomial(t, 0.166667536f, 0.0749524161f, 0.0454770997f, 0.0241475999f, 0.0422185659f);
}

// atan of x in [0, 1]: 2.3e-9.
template <class F>
F atan_of_unit(F x) {
    const F t = x * x;
    return simd::fma(
        x * t,
        polynomial(t, -0.333333015f, 0.199986383f, -0.142652452f, 0.109575771f, -0.084194608f,
                   0.0582345799f, -0.0314557292f, 0.011064454f, -0.00182721578f),
        x);
}

// x 2^n for x in [1/2, 2), through the exponent's bits: the result must be normal or infinite.
template <class F>
F scale_by_power(F x, simd::IntOf<F> n) {
    using U = simd::UintOf<F>;
    return simd::as_float(simd::as_uint(x) + (U(n) << 23));
}

// x = mantissa 2^exponent with mantissa - 1 in [sqrt(1/2) - 1, sqrt(2) - 1], for normal x > 0.
template <class F>
void split_exponent(F x, F& exponent, F& mantissa_minus_1) {
    using U = simd::UintOf<F>;
    using I = simd::IntOf<F>;
    constexpr std::uint32_t kSqrtHalf = 0x3f3504f3u;
    const U bits = simd::as_uint(x) - U(kSqrtHalf);
    const I n = I(bits) >> 23;
    exponent = simd::to_float(n);
    mantissa_minus_1 = simd::as_float(simd::as_uint(x) - (U(n) << 23)) - F(1);
}

// log(1 + f) - f for f in that interval: 7.5e-10 of log(1 + f).
template <class F>
F log_tail(F f) {
    const F p = polynomial(f, 0.333333135f, -0.250000089f, 0.200021192f, -0.166679963f,
                           0.142195523f, -0.124055885f, 0.118881613f, -0.116756529f, 0.0674664378f);
    const F square = f * f;
    return simd::fma(square * f, p, square * F(-0.5f));
}

// The values of a logarithm where its argument is not a normal positive number.
template <class F>
F with_logarithm_limits(F x, F logarithm) {
    logarithm = simd::select(x < F(kSmallestNormal), F(-kInfinity), logarithm);
    logarithm = simd::select(x < F(0), F(kNaN), logarithm);
    return simd::select(x < F(kInfinity), logarithm, x);  // inf and NaN
}

}  // namespace elementary

// Cody and Waite, "Software Manual for the Elementary Functions" (1980), ch. 8: the multiple of
// pi/2 is taken off in parts; with a fused operation the first difference is exact.
template <class F>
void sincos(F x, F& sine, F& cosine) {
    if constexpr (elementary::kIsDouble<F>) {
        sine = std::sin(x);
        cosine = std::cos(x);
    } else {
        const auto quadrant = simd::to_int(simd::round(x * F(0.636619747f)));
        const F k = simd::to_float(quadrant);
        F r = simd::fma(k, F(-0x1.921fb4p+0f), x);
        r = simd::fma(k, F(-0x1.4442dp-24f), r);
        r = simd::fma(k, F(-0x1.846988p-48f), r);
        // Holds far arguments to the interval of the polynomials.
        r = simd::min(F(0.8f), simd::max(F(-0.8f), r));
        r = simd::select(simd::abs(x) < F(elementary::kInfinity), r, F(elementary::kNaN));
        elementary::sincos_of_quadrant(r, simd::UintOf<F>(quadrant), sine, cosine);
    }
}

template <class F>
F sin(F x) {
    F sine, cosine;
    sincos(x, sine, cosine);
    return sine;
}

template <class F>
F cos(F x) {
    F sine, cosine;
    sincos(x, sine, cosine);
    return cosine;
}

// Of 2 pi turns. Multiples of 1/4 give exactly 0, 1 and -1.
template <class F>
void sincos_two_pi(F turns, F& sine, F& cosine) {
    if constexpr (elementary::kIsDouble<F>) {
        sincos(2 * 3.14159265358979323846 * (turns - std::nearbyint(turns)), sine, cosine);
    } else {
        const F fraction = turns - simd::round(turns);  // exact
        const auto quadrant = simd::to_int(simd::round(fraction * F(4)));
        const F rest = simd::fma(simd::to_float(quadrant), F(-0.25f), fraction);  // exact
        elementary::sincos_of_quadrant(rest * F(2 * elementary::kPi), simd::UintOf<F>(quadrant),
                                       sine, cosine);
    }
}

// asin(y) with y = |x| or, above 1/2, sqrt((1 - |x|) / 2), where acos |x| = 2 asin y.
template <class F>
F acos(F x) {
    if constexpr (elementary::kIsDouble<F>) {
        return std::acos(simd::min(1.0, simd::max(-1.0, x)));
    } else {
        using namespace elementary;
        x = simd::min(F(1), simd::max(F(-1), x));
        const F magnitude = simd::abs(x);
        const auto outer = magnitude > F(0.5f);
        const F half_complement = simd::fma(magnitude, F(-0.5f), F(0.5f));
        const F t = simd::select(outer, half_complement, x * x);
        const F y = simd::select(outer, simd::sqrt(half_complement), x);
        const F arc = simd::fma(y * t, asin_tail(t), y);
        const F twice = arc + arc;
        const F reflected = simd::select(x < F(0), F(kPi) - (twice - F(kPiLow)), twice);
        return simd::select(outer, reflected, F(kHalfPi) - (arc - F(kHalfPiLow)));
    }
}

template <class F>
F atan2(F y, std::type_identity_t<F> x) {
    if constexpr (elementary::kIsDouble<F>) {
        return std::atan2(y, x);
    } else {
        using namespace elementary;
        const F along = simd::abs(x);
        const F across = simd::abs(y);
        const F larger = simd::max(along, across);
        // Equal ones are 1 (also infinities), except for zeros.
        F slope = simd::select(along == across, F(1), simd::min(along, across) / larger);
        slope = simd::select(larger == F(0), F(0), slope);
        F angle = atan_of_unit(slope);
        angle = simd::select(across > along, F(kHalfPi) - (angle - F(kHalfPiLow)), angle);
        const auto leftwards = simd::as_int(x) < simd::IntOf<F>(0);  // the sign bit, also of zero
        angle = simd::select(leftwards, F(kPi) - (angle - F(kPiLow)), angle);
        angle = simd::copysign(angle, y);
        return simd::select((x != x) | (y != y), F(kNaN), angle);
    }
}

template <class F>
F atan(F x) {
    return atan2(x, F(1));
}

template <class F>
F exp2(F x) {
    if constexpr (elementary::kIsDouble<F>) {
        return std::exp2(x);
    } else {
        using namespace elementary;
        const F held = simd::min(F(128), simd::max(F(-127), x));
        const F whole = simd::round(held);
        const F r = held - whole;
        // 2^r = 1 + r P(r), |r| <= 1/2: 1.9e-9.
        const F p = simd::fma(r,
                              polynomial(r, 0.693147182f, 0.240226507f, 0.055503279f,
                                         0.00961800385f, 0.00134002697f, 0.000154763009f),
                              F(1));
        return simd::select(x < F(-126), F(0), scale_by_power(p, simd::to_int(whole)));
    }
}

template <class F>
F exp(F x) {
    if constexpr (elementary::kIsDouble<F>) {
        return std::exp(x);
    } else {
        using namespace elementary;
        constexpr float kLargest = 88.7228317f;    // just below ln 2^128
        constexpr float kSmallest = -87.3365402f;  // just above ln 2^-126
        const F held = simd::min(F(kLargest), simd::max(F(kSmallest), x));
        const F whole = simd::round(held * F(0x1.715476p+0f));
        F r = simd::fma(whole, F(-kLn2), held);
        r = simd::fma(whole, F(-kLn2Low), r);
        // e^r = 1 + r + r r P(r), |r| <= ln(2)/2: 3.2e-9.
        const F tail =
            polynomial(r, 0.5f, 0.166665182f, 0.0416661948f, 0.00836896431f, 0.00139513449f);
        const F p = F(1) + simd::fma(r * r, tail, r);
        const F power = scale_by_power(p, simd::to_int(whole));
        return simd::select(x > F(kLargest), F(kInfinity),
                            simd::select(x < F(kSmallest), F(0), power));
    }
}

template <class F>
F log(F x) {
    if constexpr (elementary::kIsDouble<F>) {
        return std::log(x);
    } else {
        using namespace elementary;
        F n, f;
        split_exponent(x, n, f);
        const F tail = simd::fma(n, F(kLn2Low), log_tail(f));
        return with_logarithm_limits(x, simd::fma(n, F(kLn2), f + tail));
    }
}

template <class F>
F log2(F x) {
    if constexpr (elementary::kIsDouble<F>) {
        return std::log2(x);
    } else {
        using namespace elementary;
        constexpr float kLog2E = 0x1.715476p+0f;
        constexpr float kLog2ELow = 0x1.4ae0cp-26f;
        F n, f;
        split_exponent(x, n, f);
        const F tail = simd::fma(f, F(kLog2ELow), log_tail(f) * F(kLog2E));
        return with_logarithm_limits(x, n + simd::fma(f, F(kLog2E), tail));
    }
}

template <class F>
F pow(F x, std::type_identity_t<F> y) {
    if constexpr (elementary::kIsDouble<F>) {
        return std::pow(x, y);
    } else {
        const F power = exp2(y * log2(x));
        return simd::select((y == F(0)) | (x == F(1)), F(1), power);
    }
}

}  // namespace penumbra
