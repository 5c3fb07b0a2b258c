#include "apps/cli/diff_options.h"

#include "core/error.h"

namespace penumbra::cli {
namespace {

std::string metric_names(bool similarities) {
    std::string names;
    for (const diff::MetricInfo& metric : diff::metric_table())
        if (metric.is_similarity == similarities)
            names += (names.empty() ? "" : ", ") + std::string(metric.name);
    return names;
}

diff::MetricSet chosen_metrics(const DiffOptions& options,
                               const std::vector<diff::Threshold>& thresholds) {
    diff::MetricSet set;
    for (const std::string& name : options.metrics) set.add(diff::parse_metric(name));
    if (options.metrics.empty())
        for (const diff::MetricInfo& metric : diff::metric_table()) set.add(metric.metric);
    for (const diff::Threshold& threshold : thresholds) set.add(threshold.metric);
    return set;
}

}  // namespace

void declare_options(CLI::App& command, DiffOptions& o) {
    command
        .add_option("REF", o.reference,
                    "Reference: EXR, HDR, PNG or JPEG file, pattern (ref.####.exr) or folder")
        ->required();
    command.add_option("TEST", o.test, "What is compared with it: of the same kind")->required();
    command
        .add_option("--fail-above", o.fail_above,
                    "METRIC=VALUE, repeatable: fail where an error is above it: " +
                        metric_names(false) + " [without thresholds any difference fails]")
        ->allow_extra_args(false);
    command
        .add_option(
            "--fail-below", o.fail_below,
            "METRIC=VALUE, repeatable: fail where a similarity is below it: " + metric_names(true))
        ->allow_extra_args(false);
    command
        .add_option("--pixel-threshold", o.pixel_threshold,
                    "A pixel counts for `pixels` and `share` where a channel differs by more")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command
        .add_option("--metrics", o.metrics,
                    "Which to compute, a list with commas; those of thresholds always are [all]")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_option("--mask", o.mask,
                       "Image of the same size: only pixels of at least 0.5 are compared");
    command
        .add_option("--ignore-layers", o.ignored_layers,
                    "Layers that are not compared, a list with commas; R G B A without a prefix "
                    "are the layer beauty")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_option("--heatmap", o.heatmap,
                       "Write the error map as PNG; '####' is the frame number of several files");
    command.add_option("--json", o.json, "Write all numbers to this JSON file");
    command.add_option("--html", o.html,
                       "Write a page with pictures: flip, slider, zoom, the worst tiles");
    command
        .add_option("--threads", o.threads,
                    "Threads; change no result [what affinity, cgroup quota and Slurm allow]")
        ->check(CLI::Range(1, 1024));
}

diff::CompareSettings interpret(const DiffOptions& o, std::optional<diff::Mask>& mask) {
    diff::CompareSettings settings;
    for (const std::string& text : o.fail_above)
        settings.thresholds.push_back(diff::parse_threshold(text, diff::Direction::kAbove));
    for (const std::string& text : o.fail_below)
        settings.thresholds.push_back(diff::parse_threshold(text, diff::Direction::kBelow));
    settings.metrics = chosen_metrics(o, settings.thresholds);
    settings.pixel_threshold = o.pixel_threshold;
    settings.ignored_layers = {o.ignored_layers.begin(), o.ignored_layers.end()};
    if (!o.mask.empty()) settings.mask = &mask.emplace(o.mask);
    settings.pictures = !o.html.empty()      ? diff::PictureWish::kAll
                        : !o.heatmap.empty() ? diff::PictureWish::kHeat
                                             : diff::PictureWish::kNone;
    return settings;
}

}  // namespace penumbra::cli
