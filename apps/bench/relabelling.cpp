#include "apps/bench/relabelling.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/error.h"

namespace penumbra::bench {
namespace {

// Which launches are called new.
using Labels = std::vector<char>;

// Of many, so many: the deviation of a probability of 0.01 is then 0.001.
constexpr double kMostLabellings = 8000;
constexpr double kFewestLabellings = 3000;
constexpr double kMostDifferences = 1e7;  // of all quantities and labellings

double count_labellings(std::size_t old_count, std::size_t new_count) {
    double ways = 1;
    for (std::size_t i = 1; i <= new_count; ++i)
        ways *= static_cast<double>(old_count + i) / static_cast<double>(i);
    return std::round(ways);
}

double median(std::vector<double>& values) {
    const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), upper, values.end());
    if (values.size() % 2 == 1) return *upper;
    return (*std::max_element(values.begin(), upper) + *upper) / 2;
}

class Strength {
  public:
    double operator()(const Quantity& values, const Labels& is_new) {
        between_.clear();
        within_.clear();
        for (std::size_t i = 0; i < values.size(); ++i)
            for (std::size_t k = i + 1; k < values.size(); ++k) {
                const double difference = values[k] - values[i];
                if (std::isnan(difference)) continue;
                if (is_new[i] == is_new[k])
                    within_.push_back(std::abs(difference));
                else
                    between_.push_back(is_new[k] ? difference : -difference);
            }
        // Labels may call all values that are there the same, or each another.
        if (between_.empty() || within_.empty()) return 0;
        const double shift = std::abs(median(between_));
        // Values that are all alike: any shift is infinitely strong.
        constexpr double kLeastScale = 1e-12;
        return shift / std::max(median(within_), kLeastScale);
    }

  private:
    std::vector<double> between_, within_;
};

// The strongest of all quantities under other labels, over and over.
class Dealer {
  public:
    Dealer(const std::vector<Quantity>& quantities, std::vector<double> observed)
        : quantities_(quantities), observed_(std::move(observed)), reached_(observed_.size(), 0) {}

    void deal(const Labels& labels) {
        double strongest = 0;
        for (const Quantity& quantity : quantities_)
            strongest = std::max(strongest, strength_(quantity, labels));
        // The sums of another order of launches may round differently.
        constexpr double kRounding = 1e-9;
        for (std::size_t i = 0; i < observed_.size(); ++i)
            reached_[i] += strongest >= observed_[i] * (1 - kRounding) ? 1 : 0;
        ++dealt_;
    }

    // `counted`: labellings that are known to reach all, but were not dealt.
    [[nodiscard]] std::vector<double> probabilities(double counted) const {
        std::vector<double> result;
        for (const double reached : reached_)
            result.push_back((reached + counted) / (dealt_ + counted));
        return result;
    }

  private:
    const std::vector<Quantity>& quantities_;
    std::vector<double> observed_, reached_;
    double dealt_ = 0;
    Strength strength_;
};

// The same on every machine, unlike std::shuffle.
void shuffle(Labels& labels, std::mt19937_64& random) {
    for (std::size_t i = labels.size(); i > 1; --i)
        std::swap(labels[i - 1], labels[static_cast<std::size_t>(random() % i)]);
}

// Without the launches that say nothing of any quantity.
struct Present {
    std::vector<Quantity> quantities;
    std::size_t old_count = 0;
};

Present present(const std::vector<Quantity>& all, std::size_t old_count) {
    Present result{.quantities = std::vector<Quantity>(all.size())};
    for (std::size_t launch = 0; launch < all.front().size(); ++launch) {
        if (std::all_of(all.begin(), all.end(),
                        [&](const Quantity& quantity) { return std::isnan(quantity[launch]); }))
            continue;
        for (std::size_t i = 0; i < all.size(); ++i) result.quantities[i].push_back(all[i][launch]);
        if (launch < old_count) ++result.old_count;
    }
    return result;
}

Labels labels_of(std::size_t launches, std::size_t old_count) {
    Labels labels(launches, 0);
    std::fill(labels.begin() + static_cast<std::ptrdiff_t>(old_count), labels.end(), 1);
    return labels;
}

}  // namespace

double shift_strength(const Quantity& quantity, std::size_t old_count) {
    return Strength()(quantity, labels_of(quantity.size(), old_count));
}

std::vector<double> corrected_probabilities(const std::vector<Quantity>& all, std::size_t all_old) {
    if (all.empty()) return {};
    const auto [quantities, old_count] = present(all, all_old);
    const std::size_t launches = quantities.front().size();
    PENUMBRA_ASSERT(old_count > 1 && launches > old_count + 1, "{} of {}", old_count, launches);
    Labels labels = labels_of(launches, old_count);
    std::vector<double> observed;
    Strength strength;
    for (const Quantity& quantity : quantities) observed.push_back(strength(quantity, labels));
    Dealer dealer(quantities, observed);
    if (count_labellings(old_count, launches - old_count) <= kMostLabellings) {
        // Sorted labels are the first permutation; the last one ends the loop.
        do dealer.deal(labels);
        while (std::next_permutation(labels.begin(), labels.end()));
        return dealer.probabilities(0);
    }
    const double work = static_cast<double>(quantities.size() * launches * launches) / 2;
    const double dealt = std::clamp(kMostDifferences / work, kFewestLabellings, kMostLabellings);
    std::mt19937_64 random(1);
    for (double i = 0; i < dealt; ++i) {
        shuffle(labels, random);
        dealer.deal(labels);
    }
    return dealer.probabilities(1);  // the labels as they are
}

double least_probability(std::size_t old_count, std::size_t new_count) {
    const double all = count_labellings(old_count, new_count);
    // With equally many the mirror image is as strong.
    const double least = (old_count == new_count ? 2 : 1) / all;
    return std::max(least, 1 / kMostLabellings);
}

}  // namespace penumbra::bench
