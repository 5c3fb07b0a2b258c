#include "apps/cli/diff_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/image/publish.h"

namespace penumbra::cli {
namespace {

using nlohmann::ordered_json;

ordered_json number_or_null(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json non_finite(const diff::NonFinite& counts) {
    return {{"nan", counts.nan}, {"infinite", counts.infinite}};
}

ordered_json layer_entry(const diff::LayerReport& layer) {
    ordered_json entry = {
        {"name", layer.name},
        {"differs", layer.differs()},
        {"pixels", layer.pixels},
        {"channels", ordered_json::array()},
        {"metrics", ordered_json::object()},
        {"non_finite",
         {{"reference", non_finite(layer.reference)}, {"test", non_finite(layer.test)}}},
        {"worst_tiles", ordered_json::array()}};
    for (const diff::ChannelReport& channel : layer.channels)
        entry["channels"].push_back({{"name", channel.name},
                                     {"type", channel.type},
                                     {"differing_pixels", channel.differing}});
    for (const diff::MetricInfo& metric : diff::metric_table())
        if (const auto& value = layer.metrics[metric.metric])
            entry["metrics"][std::string(metric.name)] = number_or_null(*value);
    for (const diff::Block& block : layer.worst)
        entry["worst_tiles"].push_back({{"x", block.x},
                                        {"y", block.y},
                                        {"width", block.width},
                                        {"height", block.height},
                                        {"error", block.error}});
    return entry;
}

ordered_json pair_entry(const diff::PairReport& pair) {
    ordered_json entry = {{"name", pair.name},
                          {"reference", pair.reference},
                          {"test", pair.test},
                          {"passed", pair.passed()},
                          {"failures", ordered_json::array()},
                          {"layers", ordered_json::array()}};
    for (const diff::Failure& failure : pair.failures) {
        ordered_json item = {{"kind", std::string(diff::name(failure.kind))}};
        if (!failure.layer.empty()) item["layer"] = failure.layer;
        item["message"] = failure.message;
        entry["failures"].push_back(std::move(item));
    }
    for (const diff::LayerReport& layer : pair.layers)
        entry["layers"].push_back(layer_entry(layer));
    return entry;
}

}  // namespace

struct DiffJson::State {
    ordered_json root;
};

DiffJson::DiffJson(const DiffOptions& options, const diff::CompareSettings& settings)
    : state_(std::make_unique<State>()) {
    ordered_json& root = state_->root;
    root = {{"software", "penumbra " PENUMBRA_VERSION},
            {"reference", options.reference},
            {"test", options.test},
            {"exit_code", 0},
            {"conventions", ordered_json::object()},
            {"pixel_threshold", settings.pixel_threshold},
            {"thresholds", ordered_json::array()},
            {"ignored_layers", settings.ignored_layers},
            {"mask", options.mask.empty() ? ordered_json(nullptr) : ordered_json(options.mask)},
            {"pairs", ordered_json::array()}};
    for (const diff::MetricInfo& metric : diff::metric_table())
        root["conventions"][std::string(metric.name)] = metric.convention;
    for (const diff::Threshold& threshold : settings.thresholds) {
        const diff::MetricInfo& metric = diff::info(threshold.metric);
        root["thresholds"].push_back({{"metric", metric.name},
                                      {"fails", metric.is_similarity ? "below" : "above"},
                                      {"value", threshold.limit}});
    }
}

DiffJson::~DiffJson() = default;

void DiffJson::add(const diff::PairReport& pair) {
    state_->root["pairs"].push_back(pair_entry(pair));
}

void DiffJson::write(const std::string& path, int exit_code) const {
    ordered_json root = state_->root;
    root["exit_code"] = exit_code;
    image::write_file_atomically(
        path, root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace penumbra::cli
