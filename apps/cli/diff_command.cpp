#include "apps/cli/diff_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/cli/diff_json.h"
#include "apps/cli/diff_options.h"
#include "apps/cli/option_checks.h"
#include "apps/cli/say.h"
#include "apps/diff/html_report.h"
#include "apps/diff/ignored_layers.h"
#include "apps/diff/pairs.h"
#include "core/error.h"
#include "core/image/publish.h"

namespace penumbra::cli {
namespace {

constexpr const char* kDiffFooter =
    "Exit codes: 0 the same or within the limits, 1 different, 2 a missing file, no image or "
    "wrong\n"
    "options, 3 output failed. NaN, incomplete files, other sizes, channels or types always "
    "fail.\n\n"
    "Examples:\n"
    "  penumbra diff golden.exr out.exr\n"
    "  penumbra diff golden.exr out.exr --fail-above flip=0.02 --html report.html\n"
    "  penumbra diff ref.####.exr out.####.exr --json report.json\n"
    "  penumbra diff golden/ rendered/ --ignore-layers id,motion";

// Of several pairs the gravest: a wrong input before a difference.
int gravest(int a, int b) {
    return std::max(a, b);
}

void print_metrics(const diff::PairReport& pair) {
    say(stdout, "  {:<16}", "layer");
    for (const diff::MetricInfo& metric : diff::metric_table()) say(stdout, " {:>10}", metric.name);
    say(stdout, "\n");
    for (const diff::LayerReport& layer : pair.layers) {
        say(stdout, "  {:<16}", one_line(layer.name));
        for (const diff::MetricInfo& metric : diff::metric_table()) {
            const auto& value = layer.metrics[metric.metric];
            say(stdout, " {:>10}", value ? fmt::format("{:.5g}", *value) : "-");
        }
        say(stdout, "\n");
    }
}

// Failures to standard output, wrong inputs to the error stream: one line each.
void print(const diff::PairReport& pair, bool is_only_one) {
    const bool differs =
        std::any_of(pair.layers.begin(), pair.layers.end(),
                    [](const diff::LayerReport& layer) { return layer.differs(); });
    const char* verdict = !pair.passed() ? "FAILED" : differs ? "within limits" : "same";
    if (pair.exit_code() != 2) say(stdout, "{}: {}\n", verdict, one_line(pair.name));
    if (differs || (is_only_one && !pair.layers.empty())) print_metrics(pair);
    for (const diff::Failure& failure : pair.failures) {
        if (diff::is_input_error(failure.kind))
            say_error(failure.message);
        else
            say(stdout, "  {}: {}{}{}\n", diff::name(failure.kind), one_line(failure.layer),
                failure.layer.empty() ? "" : ": ", one_line(failure.message));
    }
}

// The part of a pair's file name that takes the place of '#' in the heat map's.
std::string heatmap_path(const std::string& pattern, const diff::FilePair& pair,
                         const std::string& reference) {
    const std::string name = std::filesystem::path(pattern).filename().string();
    const std::size_t begin = name.find('#');
    if (begin == std::string::npos) return pattern;
    const std::string source = std::filesystem::path(reference).filename().string();
    const std::size_t before = source.find('#');
    const std::size_t after = source.size() - source.find_last_of('#') - 1;
    const std::string frame = pair.name.substr(before, pair.name.size() - before - after);
    const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
    return (std::filesystem::path(pattern).parent_path() /
            (name.substr(0, begin) + frame + name.substr(end)))
        .string();
}

void check_heatmap(const DiffOptions& options, std::size_t pairs) {
    if (options.heatmap.empty()) return;
    const bool has_number =
        std::filesystem::path(options.heatmap).filename().string().find('#') != std::string::npos;
    const bool has_frames =
        std::filesystem::path(options.reference).filename().string().find('#') !=
            std::string::npos &&
        !std::filesystem::is_directory(options.reference);
    if (!options.heatmap.ends_with(".png"))
        throw InputError(fmt::format("--heatmap: expected a name that ends in .png, got \"{}\"",
                                     options.heatmap));
    if (has_number && !has_frames) throw InputError("--heatmap: '####' needs a REF with '####'");
    if (pairs > 1 && !has_number)
        throw InputError(
            fmt::format("--heatmap: {} pairs need '####' in the file name, got \"{}\"; "
                        "folders are shown by --html",
                        pairs, options.heatmap));
}

void check_ignored(const diff::CompareSettings& settings,
                   const std::vector<diff::FilePair>& pairs) {
    for (const std::string& layer : diff::find_unknown_layers(pairs, settings.ignored_layers))
        throw InputError(fmt::format("--ignore-layers: no image has a layer \"{}\"", layer));
}

void require_files_of_their_own(const DiffOptions& options,
                                const std::vector<diff::FilePair>& pairs) {
    std::vector<PlannedFile> outputs;
    if (!options.html.empty()) outputs.emplace_back("--html", options.html);
    if (!options.json.empty()) outputs.emplace_back("--json", options.json);
    std::vector<std::filesystem::path> inputs;
    if (!options.mask.empty()) inputs.emplace_back(options.mask);
    for (const diff::FilePair& pair : pairs) {
        inputs.emplace_back(pair.reference);
        inputs.emplace_back(pair.test);
        if (!options.heatmap.empty())
            outputs.emplace_back("--heatmap",
                                 heatmap_path(options.heatmap, pair, options.reference));
    }
    require_distinct(outputs, inputs);
    require_endings(outputs);
}

int run_diff(const DiffOptions& options) {
    std::optional<diff::Mask> mask;
    const diff::CompareSettings settings = interpret(options, mask);
    const std::vector<diff::FilePair> pairs = diff::find_pairs(options.reference, options.test);
    check_heatmap(options, pairs.size());
    require_files_of_their_own(options, pairs);
    check_ignored(settings, pairs);
    const parallel::Arena arena(options.threads > 0 ? options.threads
                                                    : parallel::default_thread_count());
    DiffJson json(options, settings);
    std::optional<diff::HtmlReport> html;
    if (!options.html.empty())
        html.emplace(options.html, options.reference + " and " + options.test, settings.thresholds);
    int exit_code = 0;
    for (const diff::FilePair& pair : pairs) {
        diff::PairReport report = diff::compare_files(pair.reference, pair.test, settings, arena);
        report.name = pair.name;
        print(report, pairs.size() == 1);
        exit_code = gravest(exit_code, report.exit_code());
        json.add(report);
        if (html) html->add(report);
        if (report.heat && !options.heatmap.empty())
            image::write_png(heatmap_path(options.heatmap, pair, options.reference), *report.heat);
    }
    if (!options.json.empty()) json.write(options.json, exit_code);
    if (html) html->publish();
    return exit_code;
}

}  // namespace

std::shared_ptr<DiffOptions> add_diff_command(CLI::App& app, int& exit_code) {
    auto options = std::make_shared<DiffOptions>();
    CLI::App* command =
        app.add_subcommand("diff", "Compare images and fail where they differ too much");
    declare_options(*command, *options);
    command->footer(kDiffFooter);
    command->callback([options, command, &exit_code] {
        refuse_empty_values(*command);
        exit_code = run_diff(*options);
    });
    return options;
}

}  // namespace penumbra::cli
