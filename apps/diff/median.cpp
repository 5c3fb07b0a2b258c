#include "apps/diff/median.h"

#include <algorithm>
#include <bit>

namespace penumbra::diff {

StreamingMedian::StreamingMedian() : upper_(1u << 16), lower_(1u << 16) {}

void StreamingMedian::count_upper(std::span<const float> values) {
    for (const float value : values) {
        if (!(value > 0)) {
            ++zeros_;
            continue;
        }
        ++positives_;
        ++upper_[std::bit_cast<std::uint32_t>(value) >> 16];
        largest_ = std::max(largest_, value);
    }
}

// Of the wanted one among the positive values, counted from the smallest.
std::uint64_t StreamingMedian::rank() const {
    const std::uint64_t middle = (zeros_ + positives_) / 2;
    return middle >= zeros_ ? middle - zeros_ : positives_ / 2;
}

void StreamingMedian::choose_upper() {
    std::uint64_t seen = 0;
    for (std::uint32_t i = 0; i < upper_.size(); ++i) {
        if (seen + upper_[i] > rank()) {
            chosen_ = i;
            before_chosen_ = seen;
            return;
        }
        seen += upper_[i];
    }
}

void StreamingMedian::count_lower(std::span<const float> values) {
    for (const float value : values) {
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
        if (value > 0 && bits >> 16 == chosen_) ++lower_[bits & 0xFFFF];
    }
}

float StreamingMedian::median() const {
    std::uint64_t seen = before_chosen_;
    for (std::uint32_t i = 0; i < lower_.size(); ++i) {
        seen += lower_[i];
        if (seen > rank() && lower_[i] > 0) return std::bit_cast<float>(chosen_ << 16 | i);
    }
    return 0;
}

}  // namespace penumbra::diff
