#include "apps/check/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "core/json/node.h"
#include "core/scene/input_files.h"
#include "core/text_scan.h"

namespace penumbra::check {
namespace {

namespace fs = std::filesystem;

// A value as it would stand on the command line; lists have commas.
std::string as_text(const json::Node& node) {
    if (node.is_number()) return fmt::format("{}", node.number({-1e300, 1e300}));
    if (!node.is_list()) return node.text();
    std::string text;
    for (std::size_t i = 0; i < node.size(); ++i) {
        if (node[i].is_list()) node[i].expected("a text or a number");
        if (i > 0) text += ',';
        text += as_text(node[i]);
    }
    return text;
}

std::vector<std::string> texts(const json::Node& node) {
    if (!node.is_list()) return {node.text()};
    std::vector<std::string> list;
    for (std::size_t i = 0; i < node.size(); ++i) list.push_back(node[i].text());
    return list;
}

void read_render(const json::Node& node, std::span<const RenderOption> known,
                 RenderValues& values) {
    std::vector<std::string> names;
    for (const RenderOption& option : known) names.push_back(option.name);
    for (std::size_t i = 0; i < node.member_count(); ++i) {
        const auto [name, value] = node.member(i);
        const auto option =
            std::find_if(known.begin(), known.end(),
                         [&key = name](const RenderOption& each) { return each.name == key; });
        if (option == known.end()) node.unknown_key(name, names);
        if (!option->is_flag)
            values[name] = as_text(value);
        else if (value.boolean())
            values[name] = "true";
    }
}

void read_thresholds(const json::Node& node, diff::Direction direction,
                     std::vector<diff::Threshold>& thresholds) {
    for (const std::string& text : texts(node)) {
        try {
            thresholds.push_back(diff::parse_threshold(text, direction));
        } catch (const InputError& error) {
            node.fail(error.what());
        }
    }
}

void read_diff(const json::Node& node, CheckSettings& settings) {
    node.allow({"fail-above", "fail-below", "pixel-threshold", "ignore-layers", "mask"});
    if (const auto above = node.find("fail-above"))
        read_thresholds(*above, diff::Direction::kAbove, settings.thresholds);
    if (const auto below = node.find("fail-below"))
        read_thresholds(*below, diff::Direction::kBelow, settings.thresholds);
    if (const auto threshold = node.find("pixel-threshold"))
        settings.pixel_threshold = threshold->number(json::kNonNegative);
    if (const auto layers = node.find("ignore-layers"))
        for (const std::string& layer : texts(*layers)) settings.ignored_layers.insert(layer);
    if (const auto mask = node.find("mask"))
        settings.mask = node.file().parent_path() / mask->text();
}

}  // namespace

bool CheckSettings::tolerates_anything() const {
    const auto is_loose = [](const diff::Threshold& threshold) {
        return diff::info(threshold.metric).is_similarity || threshold.limit > 0;
    };
    return pixel_threshold > 0 || !ignored_layers.empty() || !mask.empty() ||
           std::any_of(thresholds.begin(), thresholds.end(), is_loose);
}

CheckSettings read_settings(const fs::path& file, std::span<const RenderOption> known) {
    InputFiles files;
    const json::Value value = json::parse(file, files.read(file, json::kMaxDocumentBytes));
    const json::Node document(file, value, "the document");
    document.allow({"scene", "render", "diff", "reason"});
    CheckSettings settings;
    if (const auto scene = document.find("scene"))
        settings.scene = (file.parent_path() / scene->text()).lexically_normal();
    if (const auto render = document.find("render")) read_render(*render, known, settings.render);
    if (const auto diff = document.find("diff")) read_diff(*diff, settings);
    if (const auto reason = document.find("reason")) settings.reason = trimmed(reason->text());
    if (settings.tolerates_anything() && settings.reason.empty())
        document.fail(
            "\"reason\" is missing: \"diff\" lets pictures differ, expected a text that "
            "says why");
    return settings;
}

}  // namespace penumbra::check
