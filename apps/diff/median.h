#pragma once

#include <cstdint>
#include <span>
#include <vector>

// The exact median of more values than fit into memory, in two passes over them.

namespace penumbra::diff {

// Radix selection on the bits of non-negative floats, which sort as the numbers do: the first pass
// counts their upper halves, the second the lower halves within the median's upper half. Where the
// median would be 0 it is that of the positive values: a picture that is black for the most part
// has one all the same.
class StreamingMedian {
  public:
    StreamingMedian();

    // Each pass sees the same values, in any order; negative ones count as 0.
    void count_upper(std::span<const float> values);
    void choose_upper();
    void count_lower(std::span<const float> values);

    // The upper of the two middle ones where their number is even; 0 where all values are.
    [[nodiscard]] float median() const;
    [[nodiscard]] float largest() const { return largest_; }

  private:
    [[nodiscard]] std::uint64_t rank() const;

    std::vector<std::uint64_t> upper_, lower_;
    std::uint64_t zeros_ = 0, positives_ = 0;
    std::uint32_t chosen_ = 0;
    std::uint64_t before_chosen_ = 0;
    float largest_ = 0;
};

}  // namespace penumbra::diff
