#include "apps/check/compare.h"

#include <algorithm>
#include <set>

#include "apps/check/frame_pictures.h"
#include "apps/diff/compare_files.h"
#include "core/error.h"
#include "core/image/publish.h"

namespace penumbra::check {
namespace {

namespace fs = std::filesystem;

diff::CompareSettings compare_settings(const CheckSettings& check, bool wants_pictures) {
    diff::CompareSettings settings;
    // HDR-FLIP costs more than all others together: only where a threshold asks for it.
    for (const diff::MetricInfo& metric : diff::metric_table())
        if (metric.metric != diff::Metric::kHdrFlip) settings.metrics.add(metric.metric);
    for (const diff::Threshold& threshold : check.thresholds)
        settings.metrics.add(threshold.metric);
    settings.thresholds = check.thresholds;
    settings.pixel_threshold = check.pixel_threshold;
    settings.ignored_layers = check.ignored_layers;
    settings.pictures = wants_pictures ? diff::PictureWish::kAll : diff::PictureWish::kNone;
    return settings;
}

void require_known_layers(const CheckSettings& check, const std::set<std::string>& seen) {
    for (const std::string& layer : check.ignored_layers)
        if (!seen.contains(layer))
            throw InputError(fmt::format("diff.ignore-layers: no image has a layer \"{}\"", layer));
}

std::optional<Fitness> fitness_of(const fs::path& file) {
    try {
        return judge_picture(file);
    } catch (const InputError&) {
        return std::nullopt;  // the comparison says what is wrong with it
    }
}

void drop_pictures(diff::PairReport& report) {
    report.heat.reset();
    for (diff::LayerReport& layer : report.layers) {
        layer.pictures.reset();
        layer.worst_pictures.clear();
    }
}

void keep_pictures(const PictureWish& wish, FrameOutcome& frame) {
    frame.pictures = fmt::format("{}.{}.html", wish.stem.string(), frame.frame);
    image::write_file_atomically(frame.pictures, frame_pictures(frame));
}

FrameOutcome compare_frame(const FrameOutcome& named, const diff::CompareSettings& settings,
                           const PictureWish& pictures, const parallel::Arena& arena) {
    FrameOutcome frame = named;
    frame.render_fitness = fitness_of(frame.render);
    std::error_code ignored;
    if (!fs::exists(frame.golden, ignored)) {
        frame.verdict = Verdict::kMissing;
    } else {
        frame.golden_fitness = fitness_of(frame.golden);
        frame.comparison = diff::compare_files(frame.golden, frame.render, settings, arena);
        if (!frame.comparison->passed()) frame.verdict = Verdict::kFailed;
    }
    if (pictures.is_wanted()) keep_pictures(pictures, frame);
    if (frame.comparison) drop_pictures(*frame.comparison);
    return frame;
}

void warn_of_unused(CheckOutcome& outcome) {
    for (const fs::path& golden : existing_goldens(outcome.check.name))
        if (std::none_of(outcome.frames.begin(), outcome.frames.end(),
                         [&](const FrameOutcome& frame) { return frame.golden == golden; }))
            outcome.warnings.push_back(
                fmt::format("{}: no frame is compared with it", golden.string()));
}

}  // namespace

void compare_frames(const std::vector<RenderedFrame>& renders, const PictureWish& pictures,
                    const parallel::Arena& arena, CheckOutcome& outcome) {
    std::optional<diff::Mask> mask;
    diff::CompareSettings settings = compare_settings(outcome.settings, pictures.is_wanted());
    if (!outcome.settings.mask.empty()) settings.mask = &mask.emplace(outcome.settings.mask);
    std::set<std::string> ignored;
    bool all_opened = true;
    for (const RenderedFrame& render : renders) {
        FrameOutcome frame{
            .frame = renders.size() > 1 ? render.number : "", .golden = {}, .render = render.file};
        frame.golden = golden_path(outcome.check.name, frame.frame);
        outcome.frames.push_back(compare_frame(frame, settings, pictures, arena));
        const auto& comparison = outcome.frames.back().comparison;
        all_opened = all_opened && comparison && !comparison->layers.empty();
        if (comparison)
            ignored.insert(comparison->ignored_layers.begin(), comparison->ignored_layers.end());
    }
    if (all_opened) require_known_layers(outcome.settings, ignored);
    warn_of_unused(outcome);
}

}  // namespace penumbra::check
