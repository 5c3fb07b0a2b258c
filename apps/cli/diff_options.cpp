#include "apps/cli/diff_options.h"

#include <limits>

#include "apps/cli/option_checks.h"
#include "core/error.h"

namespace penumbra::cli {
namespace {

std::vector<std::string> metric_names(std::optional<bool> similarities = std::nullopt) {
    std::vector<std::string> names;
    for (const diff::MetricInfo& metric : diff::metric_table())
        if (!similarities || metric.is_similarity == *similarities) names.emplace_back(metric.name);
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

void declare_images(CLI::App& command, DiffOptions& o) {
    command
        .add_option("REF", o.reference,
                    "The reference: an EXR, HDR, PNG or JPEG file, a pattern (ref.####.exr) or a "
                    "folder")
        ->type_name("IMAGE")
        ->required();
    command.add_option("TEST", o.test, "What is compared with it: of the same kind")
        ->type_name("IMAGE")
        ->required();
    command.option_defaults()->group("What is compared");
    command
        .add_option("--mask", o.mask,
                    "An image of the same size: only pixels of at least 0.5 are compared")
        ->type_name("IMAGE");
    command
        .add_option("--ignore-layers", o.ignored_layers,
                    "Layers that are not compared, a list with commas; R G B A without a prefix "
                    "are the layer beauty")
        ->type_name("LIST")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        .add_option("--metrics", o.metrics,
                    "Which numbers to compute, a list with commas, besides those that have limits "
                    "[all]")
        ->check(list_of(metric_names()))
        ->delimiter(',')
        ->allow_extra_args(false);
}

void declare_limits(CLI::App& command, DiffOptions& o) {
    command.option_defaults()->group("What fails: without limits, any difference");
    command
        .add_option("--fail-above", o.fail_above,
                    "Fail where an error of a layer is above the limit, e.g. flip=0.02; repeatable")
        ->type_name("METRIC=VALUE")
        ->check(value_of(metric_names(false)))
        ->allow_extra_args(false);
    command
        .add_option("--fail-below", o.fail_below,
                    "Fail where a similarity is below the limit, e.g. psnr=40; repeatable")
        ->type_name("METRIC=VALUE")
        ->check(value_of(metric_names(true)))
        ->allow_extra_args(false);
    command
        .add_option("--pixel-threshold", o.pixel_threshold,
                    "The metrics `pixels` and `share` count pixels of which a channel differs by "
                    "more than this")
        ->check(in_range(0, std::numeric_limits<double>::max()))
        ->capture_default_str();
}

void declare_reports(CLI::App& command, DiffOptions& o) {
    command.option_defaults()->group("Reports");
    command
        .add_option(
            "--html", o.html,
            "Write a page with pictures of what differs: flip, slider, zoom, the worst tiles")
        ->type_name("FILE.html");
    command.add_option("--json", o.json, "Write all numbers")->type_name("FILE.json");
    command
        .add_option("--heatmap", o.heatmap,
                    "Write a map of the errors; '####' stands for the frame number")
        ->type_name("PATTERN.png");
    command.option_defaults()->group("Running");
}

}  // namespace

void declare_options(CLI::App& command, DiffOptions& o) {
    declare_images(command, o);
    declare_limits(command, o);
    declare_reports(command, o);
    command
        .add_option("--threads", o.threads,
                    "Threads; changes no result [what affinity, cgroup quota and Slurm allow]")
        ->check(in_range(1, 1024));
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
