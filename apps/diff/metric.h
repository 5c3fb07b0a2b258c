#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The numbers that describe a difference, and the limits users set.

namespace penumbra::diff {

enum class Metric { kMax, kMae, kRmse, kRelmse, kPsnr, kSsim, kFlip, kHdrFlip, kPixels, kShare };
inline constexpr int kMetricCount = 10;

struct MetricInfo {
    Metric metric;
    std::string_view name;
    bool is_similarity;  // more is better: PSNR and SSIM
    bool needs_colour;  // of the colour channels of colour layers alone; the others of all channels
    std::string_view convention;
};
[[nodiscard]] const std::array<MetricInfo, kMetricCount>& metric_table();
[[nodiscard]] const MetricInfo& info(Metric metric);
// Throws InputError that lists the names.
[[nodiscard]] Metric parse_metric(std::string_view name);

// Values by metric; none where a metric does not apply or was not asked for.
class MetricValues {
  public:
    [[nodiscard]] std::optional<double>& operator[](Metric m) {
        return values_[static_cast<std::size_t>(m)];
    }
    [[nodiscard]] const std::optional<double>& operator[](Metric m) const {
        return values_[static_cast<std::size_t>(m)];
    }

  private:
    std::array<std::optional<double>, kMetricCount> values_{};
};

class MetricSet {
  public:
    [[nodiscard]] bool has(Metric m) const { return bits_ >> static_cast<int>(m) & 1; }
    void add(Metric m) { bits_ |= 1u << static_cast<int>(m); }
    void remove(Metric m) { bits_ &= ~(1u << static_cast<int>(m)); }

  private:
    unsigned bits_ = 0;
};

// An image fails where an error is above the limit, or a similarity below it.
struct Threshold {
    Metric metric;
    double limit;
    [[nodiscard]] bool is_broken_by(double value) const {
        return info(metric).is_similarity ? value < limit : value > limit;
    }
};

enum class Direction { kAbove, kBelow };
// "METRIC=VALUE" of --fail-above or --fail-below. Throws InputError where the metric is unknown, is
// of the other kind, or the value is not a finite number.
[[nodiscard]] Threshold parse_threshold(std::string_view text, Direction direction);

}  // namespace penumbra::diff
