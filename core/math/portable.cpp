#include "core/math/portable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace penumbra::portable {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2;

// pi / 2 in pieces of 33 bits, of which multiples up to 2^20 are exact, and the rounded rest.
constexpr double kHalfPiPieces[3] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
constexpr double kLargestReduced = 0x1p20;

struct Reduced {
    double x;      // in [-pi / 4, pi / 4], a little more by rounding
    int quadrant;  // of the circle, 0 to 3
};

Reduced reduced(double x) {
    if (std::fabs(x) > kLargestReduced) x = std::remainder(x, 4 * kHalfPi);
    const double turns = std::nearbyint(x / kHalfPi);
    for (const double piece : kHalfPiPieces) x -= turns * piece;
    const int quadrant = std::isfinite(turns) ? static_cast<int>(turns) & 3 : 0;
    return {x, quadrant};
}

// 1 - s / (n (n + 1)) (1 - s / ((n + 2)(n + 3)) (...)): the series of sine and cosine, s = x^2, cut
// where terms are below 2^-60 for |x| <= pi / 4.
double alternating_series(double s, int first) {
    double sum = 1;
    for (int n = first + 16; n >= first; n -= 2) sum = 1 - s / (n * (n + 1.0)) * sum;
    return sum;
}

double sin_reduced(double x) {
    return x * alternating_series(x * x, 2);
}
double cos_reduced(double x) {
    return alternating_series(x * x, 1);
}

// atan(i / 8)
constexpr std::array<double, 9> kAtanOfEighths = {0,
                                                  0x1.fd5ba9aac2f6ep-4,
                                                  0x1.f5b75f92c80ddp-3,
                                                  0x1.6f61941e4def1p-2,
                                                  0x1.dac670561bb4fp-2,
                                                  0x1.1e00babdefeb4p-1,
                                                  0x1.4978fa3269ee1p-1,
                                                  0x1.700a7c5784634p-1,
                                                  0x1.921fb54442d18p-1};

// Of x in [0, 1]: from the nearest eighth, by the series of the rest, at most 1 / 16.
double atan_of_share(double x) {
    const double nearest = std::nearbyint(x * 8);
    const double eighth = nearest / 8;
    const double rest = (x - eighth) / (1 + x * eighth);
    const double s = rest * rest;
    double sum = 0;
    for (int n = 15; n >= 1; n -= 2) sum = 1.0 / n - s * sum;
    return kAtanOfEighths[static_cast<std::size_t>(nearest)] + rest * sum;
}

}  // namespace

double sin(double x) {
    const auto [r, quadrant] = reduced(x);
    const double value = (quadrant & 1) != 0 ? cos_reduced(r) : sin_reduced(r);
    return (quadrant & 2) != 0 ? -value : value;
}

double cos(double x) {
    const auto [r, quadrant] = reduced(x);
    const double value = (quadrant & 1) != 0 ? sin_reduced(r) : cos_reduced(r);
    return quadrant == 1 || quadrant == 2 ? -value : value;
}

double tan(double x) {
    return sin(x) / cos(x);
}

double atan2(double y, double x) {
    const double height = std::fabs(y), width = std::fabs(x);
    const double larger = std::max(height, width);
    if (!std::isfinite(height + width)) return std::numeric_limits<double>::quiet_NaN();
    if (larger == 0) return std::copysign(std::signbit(x) ? 2 * kHalfPi : 0.0, y);
    double angle = atan_of_share(std::min(height, width) / larger);
    if (height > width) angle = kHalfPi - angle;
    if (x < 0) angle = 2 * kHalfPi - angle;
    return std::copysign(angle, y);
}

double acos(double x) {
    const double cosine = std::clamp(x, -1.0, 1.0);
    return atan2(std::sqrt((1 - cosine) * (1 + cosine)), cosine);
}

}  // namespace penumbra::portable
