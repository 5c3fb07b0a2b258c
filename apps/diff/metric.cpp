#include "apps/diff/metric.h"

#include <charconv>
#include <cmath>

#include "core/error.h"

namespace penumbra::diff {

const std::array<MetricInfo, kMetricCount>& metric_table() {
    static const std::array<MetricInfo, kMetricCount> table = {{
        {Metric::kMax, "max", false, false, "largest |test - reference| of a channel's value"},
        {Metric::kMae, "mae", false, false, "mean |test - reference| over all channel values"},
        {Metric::kRmse, "rmse", false, false,
         "square root of the mean (test - reference)^2 over all channel values"},
        {Metric::kRelmse, "relmse", false, false,
         "mean (test - reference)^2 / (reference^2 + 0.01) over all channel values"},
        {Metric::kPsnr, "psnr", true, true,
         "10 log10(1 / mean squared error) in dB, colour channels, peak 1: coded values of PNG and "
         "JPEG, values clamped to [0, 1] and sRGB-coded of EXR and HDR; infinite (null) where "
         "these are equal"},
        {Metric::kSsim, "ssim", true, true,
         "Wang et al. 2004: Gaussian window 11 x 11, sigma 1.5, K1 0.01, K2 0.03; values as for "
         "psnr; mean over the colour channels and all windows that lie in the picture whole"},
        {Metric::kFlip, "flip", false, true,
         "mean LDR-FLIP (Andersson et al. 2020), 67.02 pixels per degree; values as for psnr"},
        {Metric::kHdrFlip, "hdr-flip", false, true,
         "mean HDR-FLIP (Andersson et al. 2021), ACES tone curve, exposures from the reference; "
         "EXR "
         "and HDR only"},
        {Metric::kPixels, "pixels", false, false,
         "pixels of which a channel differs by more than the pixel threshold"},
        {Metric::kShare, "share", false, false, "those pixels divided by all compared pixels"},
    }};
    return table;
}

const MetricInfo& info(Metric metric) {
    return metric_table()[static_cast<std::size_t>(metric)];
}

Metric parse_metric(std::string_view name) {
    std::string names;
    for (const MetricInfo& each : metric_table()) {
        if (each.name == name) return each.metric;
        names += (names.empty() ? "" : ", ") + std::string(each.name);
    }
    throw InputError(fmt::format("unknown metric \"{}\", expected one of {}", name, names));
}

Threshold parse_threshold(std::string_view text, Direction direction) {
    const std::string_view option =
        direction == Direction::kAbove ? "--fail-above" : "--fail-below";
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos)
        throw InputError(fmt::format("{}: expected METRIC=VALUE, got \"{}\"", option, text));
    const std::string_view number = text.substr(equals + 1);
    Threshold threshold{parse_metric(text.substr(0, equals)), 0};
    const auto [end, error] =
        std::from_chars(number.data(), number.data() + number.size(), threshold.limit);
    if (error != std::errc{} || end != number.data() + number.size() ||
        !std::isfinite(threshold.limit))
        throw InputError(fmt::format("{}: expected a number after {}, got \"{}\"", option,
                                     text.substr(0, equals + 1), number));
    const MetricInfo& metric = info(threshold.metric);
    if (metric.is_similarity != (direction == Direction::kBelow))
        throw InputError(
            fmt::format("{}: {} is {}, use {} {}", option, metric.name,
                        metric.is_similarity ? "better when larger" : "better when smaller",
                        metric.is_similarity ? "--fail-below" : "--fail-above", text));
    return threshold;
}

}  // namespace penumbra::diff
