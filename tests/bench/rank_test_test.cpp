#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "apps/bench/rank_test.h"

using namespace penumbra::bench;

namespace {

using Values = std::vector<double>;

// Pairs (a, b) with b > a; equal ones count one half.
double count_pairs(const Values& a, const Values& b) {
    double pairs = 0;
    for (const double x : a)
        for (const double y : b) pairs += y > x ? 1 : y == x ? 0.5 : 0;
    return pairs;
}

// By dealing the values in every way, as the definition has it.
double enumerated_probability(const Values& a, const Values& b) {
    Values all = a;
    all.insert(all.end(), b.begin(), b.end());
    const double mean = static_cast<double>(a.size() * b.size()) / 2;
    const double distance = std::abs(count_pairs(a, b) - mean);
    std::vector<char> is_b(all.size(), 0);
    std::fill(is_b.begin() + static_cast<std::ptrdiff_t>(a.size()), is_b.end(), 1);
    double far = 0;
    double ways = 0;
    do {
        Values first, second;
        for (std::size_t i = 0; i < all.size(); ++i) (is_b[i] ? second : first).push_back(all[i]);
        far += std::abs(count_pairs(first, second) - mean) >= distance ? 1 : 0;
        ++ways;
    } while (std::next_permutation(is_b.begin(), is_b.end()));
    return far / ways;
}

// Values of which exactly `pairs` of the n m pairs have b > a: one value of b moves at a time.
struct Pair {
    Values a, b;
};
Pair with_pairs(int n, int m, int pairs) {
    Pair result;
    for (int i = 0; i < n; ++i) result.a.push_back(i);
    for (int k = 0; k < m; ++k) {
        const int below = std::clamp(pairs - k * n, 0, n);
        result.b.push_back(below - 0.5 + 1e-6 * k);
    }
    return result;
}

}  // namespace

TEST_CASE("the published critical values divide what is significant from what is not") {
    // Two-sided critical values of U, as in any table (e.g. Siegel and Castellan 1988, table J).
    struct Row {
        int n, m, at_5_percent, at_1_percent;
    };
    for (const Row& row : {Row{5, 5, 2, 0}, Row{6, 8, 8, 4}, Row{8, 10, 17, 11},
                           Row{10, 10, 23, 16}, Row{20, 20, 127, 105}}) {
        CAPTURE(row.n);
        const auto probability = [&](int pairs) {
            const Pair pair = with_pairs(row.n, row.m, pairs);
            const RankTest test = mann_whitney(pair.a, pair.b);
            REQUIRE(test.statistic == pairs);
            CHECK(test.is_exact);
            return test.probability;
        };
        CHECK(probability(row.at_5_percent) <= 0.05);
        CHECK(probability(row.at_5_percent + 1) > 0.05);
        CHECK(probability(row.at_1_percent) <= 0.01);
        CHECK(probability(row.at_1_percent + 1) > 0.01);
    }
}

TEST_CASE("five launches that all are slower than five others have a probability of 2 in 252") {
    const Values a = {1, 2, 3, 4, 5};
    const Values b = {6, 7, 8, 9, 10};
    CHECK(mann_whitney(a, b).probability == doctest::Approx(2.0 / 252));
    CHECK(mann_whitney(b, a).probability == doctest::Approx(2.0 / 252));
}

TEST_CASE("exact probabilities are those of dealing the values in every way, equal ones too") {
    std::mt19937_64 random(7);
    for (int trial = 0; trial < 40; ++trial) {
        Values a(3 + random() % 4), b(3 + random() % 4);
        const std::uint64_t different = 2 + random() % 12;
        for (double& value : a) value = static_cast<double>(random() % different);
        for (double& value : b) value = static_cast<double>(1 + random() % different);
        const RankTest test = mann_whitney(a, b);
        CHECK(test.statistic == count_pairs(a, b));
        CHECK(test.probability == doctest::Approx(enumerated_probability(a, b)).epsilon(1e-9));
    }
}

TEST_CASE("the normal approximation goes on where the exact distribution ends") {
    std::mt19937_64 random(11);
    for (const bool has_ties : {false, true}) {
        Values a, b;
        for (int i = 0; i < 32; ++i) {
            const double x = static_cast<double>(random() % 100000) / 100000;
            const double y = static_cast<double>(random() % 100000) / 100000 + 0.17;
            a.push_back(has_ties ? std::floor(8 * x) : x);
            b.push_back(has_ties ? std::floor(8 * y) : y);
        }
        const double exact = mann_whitney(a, b).probability;
        a.push_back(0.5);  // one more than the exact distribution takes
        if (has_ties) a.back() = 4;
        const RankTest test = mann_whitney(a, b);
        CHECK_FALSE(test.is_exact);
        CHECK(test.probability == doctest::Approx(exact).epsilon(0.35));
    }
    const Values same(40, 1.0);
    CHECK(mann_whitney(same, same).probability == 1);
}

TEST_CASE("the shift is the median of all differences, its interval what the test leaves") {
    const Values a = {1.0, 2.5, 3.1, 4.7, 5.2};
    const Values b = {11.0, 12.9, 13.3, 14.1, 15.6};
    const Shift shift = hodges_lehmann(a, b, 0.95);
    Values differences;
    for (const double x : a)
        for (const double y : b) differences.push_back(y - x);
    std::sort(differences.begin(), differences.end());
    CHECK(shift.estimate == doctest::Approx(differences[12]));
    // U <= 2 is refuted at 5 %: the third differences from both ends.
    CHECK(shift.low == doctest::Approx(differences[2]));
    CHECK(shift.high == doctest::Approx(differences[22]));
    CHECK(std::isinf(hodges_lehmann(Values{1, 2}, Values{3, 4}, 0.95).high));
}

TEST_CASE("a shift inside the interval is not refuted, one outside is") {
    std::mt19937_64 random(3);
    Values a(9), b(12);
    for (double& value : a) value = static_cast<double>(random() % 1000003) / 1000003;
    for (double& value : b) value = static_cast<double>(random() % 1000003) / 1000003 + 0.4;
    const Shift shift = hodges_lehmann(a, b, 0.99);
    const auto refuted = [&](double by) {
        Values moved = b;
        for (double& value : moved) value -= by;
        return mann_whitney(a, moved).probability <= 0.01;
    };
    CHECK_FALSE(refuted(shift.low + 1e-9));
    CHECK_FALSE(refuted(shift.high - 1e-9));
    CHECK(refuted(shift.low - 1e-9));
    CHECK(refuted(shift.high + 1e-9));
}

TEST_CASE("intervals of many values come from the approximation and hold the shift") {
    Values a, b;
    for (int i = 0; i < 50; ++i) {
        a.push_back(std::fmod(i * 0.618033988749895, 1.0));
        b.push_back(std::fmod(i * 0.754877666246693, 1.0) + 0.1);
    }
    const Shift shift = hodges_lehmann(a, b, 0.95);
    CHECK(shift.low < shift.estimate);
    CHECK(shift.estimate < shift.high);
    // Uniform values: the deviation of the shift is sqrt((n + m + 1) / (12 n m)) = 0.058.
    CHECK(shift.high - shift.low == doctest::Approx(2 * 1.96 * 0.058).epsilon(0.15));
}
