#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "apps/bench/relabelling.h"

using namespace penumbra::bench;

namespace {

// Sums of twelve: nearly normal, and the same on every machine.
double noise(std::mt19937_64& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random() >> 11) * 0x1p-53;
    return sum;
}

std::vector<Quantity> quantities(std::size_t count, std::size_t launches, std::mt19937_64& random) {
    std::vector<Quantity> all(count, Quantity(launches));
    for (Quantity& quantity : all)
        for (double& value : quantity) value = noise(random);
    return all;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

double strength(const Quantity& values, const std::vector<char>& is_new) {
    std::vector<double> between, within;
    for (std::size_t i = 0; i < values.size(); ++i)
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (!is_new[i] && is_new[k]) between.push_back(values[k] - values[i]);
            if (i < k && is_new[i] == is_new[k]) within.push_back(std::abs(values[k] - values[i]));
        }
    return std::abs(median(between)) / median(within);
}

// The part of all ways to label the launches that is as strong as the first one.
double enumerated_probability(const Quantity& values, std::size_t old_count) {
    std::vector<char> labels(values.size(), 0);
    std::fill(labels.begin() + static_cast<std::ptrdiff_t>(old_count), labels.end(), 1);
    const double observed = strength(values, labels);
    double reached = 0;
    double ways = 0;
    do {
        reached += strength(values, labels) >= observed * (1 - 1e-9) ? 1 : 0;
        ++ways;
    } while (std::next_permutation(labels.begin(), labels.end()));
    return reached / ways;
}

}  // namespace

TEST_CASE("one quantity that separates completely has the least probability") {
    const std::vector<Quantity> one = {{1.0, 1.1, 0.9, 1.05, 0.97, 9.0, 9.1, 8.9, 9.05, 8.97}};
    CHECK(corrected_probabilities(one, 5)[0] == doctest::Approx(2.0 / 252));
    CHECK(least_probability(5, 5) == doctest::Approx(2.0 / 252));
    CHECK(least_probability(5, 6) == doctest::Approx(1.0 / 462));
}

TEST_CASE("a strong shift is found among ten quantities without one, by five launches") {
    std::mt19937_64 random(5);
    std::vector<Quantity> all = quantities(10, 10, random);
    for (std::size_t launch = 5; launch < 10; ++launch) all[3][launch] += 20;
    const std::vector<double> p = corrected_probabilities(all, 5);
    for (std::size_t i = 0; i < all.size(); ++i) CHECK((p[i] <= 0.01) == (i == 3));
}

TEST_CASE("what nothing distinguishes has a probability of 1") {
    const std::vector<Quantity> equal = {{2, 2, 2, 2, 2, 2}, {1, 5, 3, 1, 5, 3}};
    const std::vector<double> p = corrected_probabilities(equal, 3);
    CHECK(p[0] == 1);
    CHECK(p[1] > 0.5);
    CHECK(corrected_probabilities({}, 3).empty());
}

TEST_CASE("a quantity told twice counts once: correlation is not paid for") {
    std::mt19937_64 random(9);
    std::vector<Quantity> one = quantities(1, 12, random);
    for (std::size_t launch = 6; launch < 12; ++launch) one[0][launch] += 1.5;
    const std::vector<double> alone = corrected_probabilities(one, 6);
    const std::vector<double> twice = corrected_probabilities({one[0], one[0], one[0]}, 6);
    for (const double p : twice) CHECK(p == alone[0]);
}

TEST_CASE("launches that say nothing are as if they had not been") {
    std::mt19937_64 random(21);
    std::vector<Quantity> all = quantities(3, 10, random);
    for (std::size_t launch = 5; launch < 10; ++launch) all[1][launch] += 3;
    const std::vector<double> p = corrected_probabilities(all, 5);
    std::vector<Quantity> with_holes = all;
    for (std::size_t i = 0; i < all.size(); ++i) {
        with_holes[i].insert(with_holes[i].begin() + 7, kMissing);  // a new one
        with_holes[i].insert(with_holes[i].begin() + 2, kMissing);  // an old one
        CHECK(shift_strength(with_holes[i], 6) == shift_strength(all[i], 5));
    }
    CHECK(corrected_probabilities(with_holes, 6) == p);
}

TEST_CASE("a launch that says nothing of one quantity counts for the others") {
    // The first one's shift needs the launches that the second one lacks.
    std::vector<Quantity> two(2);
    std::mt19937_64 random(23);
    for (int launch = 0; launch < 16; ++launch) {
        two[0].push_back(noise(random) + (launch < 8 ? 0 : 30));
        two[1].push_back(launch % 4 == 0 ? kMissing : noise(random));
    }
    const std::vector<double> p = corrected_probabilities(two, 8);
    CHECK(p[0] < 0.001);
    CHECK(p[1] > 0.05);
    // Where a quantity is missing wherever labels differ, nothing can be said.
    CHECK(shift_strength({1, 2, 3, kMissing, kMissing, kMissing}, 3) == 0);
}

TEST_CASE("random labels come near to all of them, and are the same in each call" *
          doctest::test_suite("statistics")) {
    std::mt19937_64 random(13);
    std::vector<Quantity> one = quantities(1, 18, random);  // 48620 ways, of which some are drawn
    for (std::size_t launch = 9; launch < 18; ++launch) one[0][launch] += 1;
    const std::vector<double> p = corrected_probabilities(one, 9);
    CHECK(p == corrected_probabilities(one, 9));
    // 8000 draws: three deviations.
    const double exact = enumerated_probability(one[0], 9);
    CHECK(std::abs(p[0] - exact) < 3 * std::sqrt(exact / 8000));
    CHECK(exact > 0.01);
    CHECK(exact < 0.3);
}

TEST_CASE("where nothing changed, anything is reported in as few comparisons as is claimed") {
    // Heavy tails: one launch in ten is disturbed. 300 comparisons at 5 %: 15 expected, and fewer
    // than 27 with a probability of 0.997.
    std::mt19937_64 random(17);
    int alarms = 0;
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<Quantity> all = quantities(8, 10, random);
        for (Quantity& quantity : all)
            for (double& value : quantity) value *= random() % 10 == 0 ? 5 : 1;
        const std::vector<double> p = corrected_probabilities(all, 5);
        bool is_alarm = false;
        for (const double each : p) is_alarm |= each <= 0.05;
        alarms += is_alarm ? 1 : 0;
    }
    CHECK(alarms < 27);
    CHECK(alarms > 3);  // and it is not idle
}
