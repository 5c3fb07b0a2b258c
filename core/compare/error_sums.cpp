#include "core/compare/error_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra::compare {
namespace {

double mean(double sum, std::uint64_t count) {
    return count == 0 ? 0 : sum / static_cast<double>(count);
}

}  // namespace

void ErrorSums::add(double reference, double test) {
    const double difference = test - reference;
    const double square = difference * difference;
    ++values;
    largest = std::max(largest, std::abs(difference));
    absolute += std::abs(difference);
    squared += square;
    relative_squared += square / (reference * reference + 0.01);
}

void ErrorSums::add(const ErrorSums& block) {
    values += block.values;
    largest = std::max(largest, block.largest);
    absolute += block.absolute;
    squared += block.squared;
    relative_squared += block.relative_squared;
}

double ErrorSums::mae() const {
    return mean(absolute, values);
}

double ErrorSums::rmse() const {
    return std::sqrt(mean(squared, values));
}

double ErrorSums::relmse() const {
    return mean(relative_squared, values);
}

double ErrorSums::psnr() const {
    if (squared == 0) return std::numeric_limits<double>::infinity();
    return -10 * std::log10(mean(squared, values));
}

}  // namespace penumbra::compare
