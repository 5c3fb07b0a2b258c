#include "apps/diff/compare_files.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "apps/diff/layers.h"
#include "apps/diff/part_comparison.h"
#include "core/error.h"

namespace penumbra::diff {
namespace {

// The mask has to have the size of the display window; nothing else is compared then.
std::optional<Failure> check_mask(const Mask* mask, const ImageSource& image,
                                  const std::string& path) {
    if (mask == nullptr) return std::nullopt;
    for (const SourcePart& part : image.parts())
        if (part.display.width() != mask->width() || part.display.height() != mask->height())
            return Failure{
                FailureKind::kMask, "",
                fmt::format("--mask: has {} x {} pixels, but {} has {} x {}", mask->width(),
                            mask->height(), path, part.display.width(), part.display.height())};
    return std::nullopt;
}

// What holds the data windows of all parts.
image::Window window_of(const ImageSource& image) {
    image::Window all = image.parts().front().data;
    for (const SourcePart& part : image.parts())
        all = {std::min(all.x0, part.data.x0), std::min(all.y0, part.data.y0),
               std::max(all.x1, part.data.x1), std::max(all.y1, part.data.y1)};
    return all;
}

std::vector<LayerPair> pair_layers(const ImageSource& reference, const ImageSource& test, int part,
                                   const std::set<std::string>& ignored) {
    const auto& names = reference.parts()[static_cast<std::size_t>(part)].channels;
    const auto& others = test.parts()[static_cast<std::size_t>(part)].channels;
    std::vector<LayerPair> pairs;
    for (const Layer& layer : find_layers(reference)) {
        if (layer.part != part || ignored.contains(layer.name)) continue;
        LayerPair pair{layer, {}};
        for (const int channel : layer.channels) {
            const std::string& name = names[static_cast<std::size_t>(channel)].name;
            const auto at = std::find_if(others.begin(), others.end(),
                                         [&](const SourceChannel& c) { return c.name == name; });
            pair.test_channels.push_back(static_cast<int>(at - others.begin()));
        }
        pairs.push_back(std::move(pair));
    }
    return pairs;
}

void judge_non_finite(const LayerReport& layer, std::vector<Failure>& failures) {
    const auto describe = [](const NonFinite& n) {
        return fmt::format("{} NaN and {} infinite", n.nan, n.infinite);
    };
    if (layer.reference.nan + layer.reference.infinite + layer.test.nan + layer.test.infinite == 0)
        return;
    failures.push_back({FailureKind::kNonFinite, layer.name,
                        fmt::format("values that are no finite numbers: {} in the reference, {} in "
                                    "the test",
                                    describe(layer.reference), describe(layer.test))});
}

void judge_layer(const LayerReport& layer, const CompareSettings& settings,
                 std::vector<Failure>& failures) {
    judge_non_finite(layer, failures);
    bool covers_all = false, covers_colour = false;
    for (const Threshold& threshold : settings.thresholds) {
        const std::optional<double>& value = layer.metrics[threshold.metric];
        if (!value) continue;
        (info(threshold.metric).needs_colour ? covers_colour : covers_all) = true;
        if (!threshold.is_broken_by(*value)) continue;
        failures.push_back(
            {FailureKind::kThreshold, layer.name,
             fmt::format("{} is {:.6g}, {} {:.6g}", info(threshold.metric).name, *value,
                         info(threshold.metric).is_similarity ? "below" : "above",
                         threshold.limit)});
    }
    if (covers_all) return;
    std::string channels;
    std::uint64_t most = 0;
    for (const ChannelReport& channel : layer.channels) {
        if (channel.differing == 0 || (covers_colour && channel.is_colour)) continue;
        channels += (channels.empty() ? "" : " ") + channel.name;
        most = std::max(most, channel.differing);
    }
    if (channels.empty()) return;
    const char* const why = settings.thresholds.empty() ? "" : ", and no threshold covers that";
    failures.push_back(
        {FailureKind::kDiffers, layer.name,
         fmt::format("{}: up to {} of {} pixels differ{}", channels, most, layer.pixels, why)});
}

void compare_parts(ImageSource& reference, ImageSource& test, const CompareSettings& settings,
                   const parallel::Arena& arena, PairReport& report) {
    std::optional<HeatCanvas> heat;
    if (settings.pictures != PictureWish::kNone) heat.emplace(window_of(reference));
    for (int part = 0; part < static_cast<int>(reference.parts().size()); ++part) {
        const auto layers = pair_layers(reference, test, part, settings.ignored_layers);
        if (layers.empty()) continue;
        const PartTiles tiles(reference, test, part, settings, arena);
        auto reports = compare_part(tiles, layers, heat ? &*heat : nullptr);
        report.layers.insert(report.layers.end(), std::make_move_iterator(reports.begin()),
                             std::make_move_iterator(reports.end()));
    }
    if (heat) report.heat = heat->picture();
}

void judge(const CompareSettings& settings, PairReport& report) {
    if (report.layers.empty())
        report.failures.push_back(
            {FailureKind::kNothing, "",
             fmt::format("--ignore-layers: leaves nothing of {} to compare", report.reference)});
    for (const LayerReport& layer : report.layers) {
        if (layer.pixels > 0) continue;
        report.failures.push_back(
            {FailureKind::kMask, "",
             fmt::format("--mask: leaves no pixel of {} to compare", report.reference)});
        return;
    }
    for (const LayerReport& layer : report.layers) judge_layer(layer, settings, report.failures);
}

}  // namespace

PairReport compare_files(const std::filesystem::path& reference, const std::filesystem::path& test,
                         const CompareSettings& settings, const parallel::Arena& arena) {
    PairReport report;
    report.name = reference.filename().string();
    report.reference = reference.string();
    report.test = test.string();
    const auto a = open_image(reference, arena.threads(), report.failures);
    const auto b = open_image(test, arena.threads(), report.failures);
    if (!a || !b) return report;
    for (const ImageSource* image : {a.get(), b.get()})
        for (const Layer& layer : find_layers(*image))
            if (settings.ignored_layers.contains(layer.name))
                report.ignored_layers.push_back(layer.name);
    report.failures = compare_structure(*a, *b, settings.ignored_layers);
    if (!report.failures.empty()) return report;
    if (const auto failure = check_mask(settings.mask, *a, report.reference)) {
        report.failures.push_back(*failure);
        return report;
    }
    try {
        compare_parts(*a, *b, settings, arena, report);
    } catch (const InputError& error) {
        report.failures.push_back({FailureKind::kDamaged, "", error.what()});
        return report;
    }
    judge(settings, report);
    return report;
}

}  // namespace penumbra::diff
