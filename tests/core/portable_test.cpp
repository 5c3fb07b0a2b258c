#include "core/math/portable.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

namespace penumbra {
namespace {

// |error| <= 4 units in the last place of the value, or 2^-52 of the largest value of the function.
bool is_close(double value, double expected) {
    return std::fabs(value - expected) <= 0x1p-50 * std::fabs(expected) + 0x1p-52;
}

class Bits {
  public:
    void add(double x) { hash_ = (hash_ ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3u; }
    [[nodiscard]] std::uint64_t hash() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace

TEST_CASE("portable sine, cosine and tangent are those of the C library but for rounding") {
    std::mt19937_64 random(1);
    int wrong = 0;
    for (int i = 0; i < 200000; ++i) {
        const double range = i % 3 == 0 ? 1.0 : i % 3 == 1 ? 20.0 : 1e5;
        const double x = std::uniform_real_distribution<double>(-range, range)(random);
        wrong += !is_close(portable::sin(x), std::sin(x));
        wrong += !is_close(portable::cos(x), std::cos(x));
        if (std::fabs(std::cos(x)) > 0.01)
            wrong += !(std::fabs(portable::tan(x) - std::tan(x)) <=
                       0x1p-45 * std::fabs(std::tan(x)) + 0x1p-52);
    }
    CHECK(wrong == 0);
}

TEST_CASE("portable arctangent and arccosine are those of the C library but for rounding") {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> unit(-1, 1);
    int wrong = 0;
    for (int i = 0; i < 200000; ++i) {
        const double y = unit(random) * (i % 4 == 0 ? 1e-9 : 1);
        const double x = unit(random) * (i % 4 == 1 ? 1e-9 : 1);
        wrong += !is_close(portable::atan2(y, x), std::atan2(y, x));
        wrong += !is_close(portable::acos(x), std::acos(x));
    }
    for (int i = -16; i <= 16; ++i)
        for (int k = -16; k <= 16; ++k) wrong += !is_close(portable::atan2(i, k), std::atan2(i, k));
    CHECK(wrong == 0);
}

TEST_CASE("portable functions keep what is exact") {
    CHECK(portable::sin(0.0) == 0);
    CHECK(portable::cos(0.0) == 1);
    CHECK(portable::acos(1.0) == 0);
    CHECK(portable::acos(1.5) == 0);
    CHECK(portable::acos(-1.5) == std::numbers::pi);
    CHECK(portable::atan2(0.0, -1.0) == std::numbers::pi);
    CHECK(portable::atan2(-0.0, -1.0) == -std::numbers::pi);
    CHECK(portable::atan2(1.0, 0.0) == std::numbers::pi / 2);
    CHECK(portable::atan2(1.0, 1.0) == std::numbers::pi / 4);
    CHECK(std::signbit(portable::atan2(-0.0, 1.0)));
}

TEST_CASE("portable functions of what is no number are no numbers") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double x : {nan, infinity, -infinity}) {
        CHECK(std::isnan(portable::sin(x)));
        CHECK(std::isnan(portable::cos(x)));
        CHECK(std::isnan(portable::atan2(x, 1.0)));
        CHECK(std::isnan(portable::atan2(1.0, x)));
    }
    CHECK(std::isnan(portable::acos(nan)));
}

TEST_CASE("portable functions have the same bits on every machine") {
    Bits bits;
    for (int i = -5000; i <= 5000; ++i) {
        const double x = 0.001 * i;
        bits.add(portable::sin(x));
        bits.add(portable::cos(7 * x));
        bits.add(portable::tan(0.3 * x));
        bits.add(portable::atan2(x, 1.7));
        bits.add(portable::acos(0.2 * x));
    }
    CHECK(bits.hash() == 1263395915173348212u);
}

}  // namespace penumbra
