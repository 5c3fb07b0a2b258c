#include "apps/bench/rank_test.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"

namespace penumbra::bench {
namespace {

// Twice the rank of each of `a`, then of each of `b`, among all: whole numbers also for mid-ranks.
struct Ranks {
    std::vector<int> doubled;
    double tie_term = 0;  // the sum of t^3 - t over groups of t equal values
};

Ranks rank(std::span<const double> a, std::span<const double> b) {
    std::vector<double> values(a.begin(), a.end());
    values.insert(values.end(), b.begin(), b.end());
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t k) { return values[i] < values[k]; });
    Ranks ranks{.doubled = std::vector<int>(values.size())};
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first + 1;
        while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
        // Ranks first + 1 to end: twice their mean.
        for (std::size_t i = first; i < end; ++i)
            ranks.doubled[order[i]] = static_cast<int>(first + 1 + end);
        const auto equal = static_cast<double>(end - first);
        ranks.tie_term += equal * equal * equal - equal;
        first = end;
    }
    return ranks;
}

// In how many ways `chosen` of the numbers add up to each sum.
std::vector<double> count_sums(const std::vector<int>& numbers, std::size_t chosen) {
    const auto most = static_cast<std::size_t>(std::accumulate(numbers.begin(), numbers.end(), 0));
    std::vector<std::vector<double>> ways(chosen + 1, std::vector<double>(most + 1, 0.0));
    ways[0][0] = 1;
    std::size_t seen = 0;
    for (const int number : numbers) {
        ++seen;
        const auto step = static_cast<std::size_t>(number);
        for (std::size_t count = std::min(seen, chosen); count > 0; --count)
            for (std::size_t sum = most; sum >= step; --sum)
                ways[count][sum] += ways[count - 1][sum - step];
    }
    return std::move(ways[chosen]);
}

// The part of all ways in which the sum is as far from its mean as `sum`, or farther.
double exact_probability(const Ranks& ranks, std::size_t chosen, int sum) {
    const std::vector<double> ways = count_sums(ranks.doubled, chosen);
    const double mean =
        static_cast<double>(chosen) * (static_cast<double>(ranks.doubled.size()) + 1);
    const double distance = std::abs(sum - mean);
    double all = 0;
    double far = 0;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        all += ways[i];
        if (std::abs(static_cast<double>(i) - mean) >= distance) far += ways[i];
    }
    return far / all;
}

double normal_probability(double statistic, double n, double m, double tie_term) {
    const double all = n + m;
    const double variance = n * m / 12 * (all + 1 - tie_term / (all * (all - 1)));
    if (variance <= 0) return 1;
    const double distance = std::max(std::abs(statistic - n * m / 2) - 0.5, 0.0);
    return std::erfc(distance / std::sqrt(2 * variance));
}

// The largest count k such that, without ties, fewer than k pairs (a, b) with b > a are so rare
// that they and their mirror image are less likely than 1 - confidence; 0 if there is none.
std::size_t refuted_pairs(std::size_t n, std::size_t m, double confidence) {
    const double tail = (1 - confidence) / 2;
    std::size_t k = 0;
    if (n + m > kMostExact) {
        const auto rows = static_cast<double>(n);
        const auto columns = static_cast<double>(m);
        while (normal_probability(static_cast<double>(k), rows, columns, 0) / 2 <= tail) ++k;
        return k;
    }
    std::vector<int> ranks(n + m);
    std::iota(ranks.begin(), ranks.end(), 1);
    const std::vector<double> ways = count_sums(ranks, m);
    const double all = std::accumulate(ways.begin(), ways.end(), 0.0);
    const std::size_t least = m * (m + 1) / 2;  // the rank sum without any pair
    double sum = 0;
    while (least + k < ways.size()) {
        sum += ways[least + k];
        if (sum / all > tail) break;
        ++k;
    }
    return k;
}

}  // namespace

RankTest mann_whitney(std::span<const double> a, std::span<const double> b) {
    PENUMBRA_ASSERT(!a.empty() && !b.empty(), "{} and {} values", a.size(), b.size());
    const Ranks ranks = rank(a, b);
    const int sum = std::accumulate(ranks.doubled.begin() + static_cast<std::ptrdiff_t>(a.size()),
                                    ranks.doubled.end(), 0);
    const auto n = static_cast<double>(a.size());
    const auto m = static_cast<double>(b.size());
    RankTest test{.statistic = sum / 2.0 - m * (m + 1) / 2,
                  .is_exact = a.size() + b.size() <= kMostExact};
    test.probability = test.is_exact ? exact_probability(ranks, b.size(), sum)
                                     : normal_probability(test.statistic, n, m, ranks.tie_term);
    return test;
}

Shift hodges_lehmann(std::span<const double> a, std::span<const double> b, double confidence) {
    PENUMBRA_ASSERT(!a.empty() && !b.empty(), "{} and {} values", a.size(), b.size());
    std::vector<double> differences;
    differences.reserve(a.size() * b.size());
    for (const double first : a)
        for (const double second : b) differences.push_back(second - first);
    std::sort(differences.begin(), differences.end());
    const std::size_t count = differences.size();
    const std::size_t outside = refuted_pairs(a.size(), b.size(), confidence);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {.estimate = (differences[(count - 1) / 2] + differences[count / 2]) / 2,
            .low = outside > 0 ? differences[outside - 1] : -kInfinity,
            .high = outside > 0 ? differences[count - outside] : kInfinity};
}

}  // namespace penumbra::bench
