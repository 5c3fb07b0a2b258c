#include "apps/cli/check_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace penumbra::cli {
namespace {

using nlohmann::ordered_json;

ordered_json metrics_of(const diff::PairReport& comparison) {
    ordered_json layers = ordered_json::object();
    for (const diff::LayerReport& layer : comparison.layers) {
        ordered_json& metrics = layers[layer.name] = ordered_json::object();
        for (const diff::MetricInfo& metric : diff::metric_table())
            if (const auto& value = layer.metrics[metric.metric])
                metrics[std::string(metric.name)] =
                    std::isfinite(*value) ? ordered_json(*value) : ordered_json(nullptr);
    }
    return layers;
}

ordered_json frame_entry(const check::FrameOutcome& frame) {
    ordered_json entry = {{"frame", frame.frame},
                          {"golden", frame.golden.string()},
                          {"verdict", check::name(frame.verdict)},
                          {"failures", ordered_json::array()}};
    if (!frame.message.empty()) entry["message"] = frame.message;
    if (!frame.comparison) return entry;
    for (const diff::Failure& failure : frame.comparison->failures)
        entry["failures"].push_back({{"kind", diff::name(failure.kind)},
                                     {"layer", failure.layer},
                                     {"message", failure.message}});
    entry["metrics"] = metrics_of(*frame.comparison);
    return entry;
}

ordered_json check_entry(const check::CheckOutcome& outcome) {
    ordered_json entry = {{"name", outcome.check.name},
                          {"verdict", check::name(outcome.verdict())},
                          {"seconds", outcome.seconds},
                          {"command", outcome.command},
                          {"frames", ordered_json::array()}};
    if (outcome.error)
        entry["error"] = {{"kind", check::name(outcome.error->kind)},
                          {"message", outcome.error->message},
                          {"log", outcome.log}};
    for (const check::FrameOutcome& frame : outcome.frames)
        entry["frames"].push_back(frame_entry(frame));
    return entry;
}

}  // namespace

std::string check_json(const std::vector<check::CheckOutcome>& outcomes,
                       const std::string& accept_command) {
    ordered_json root = {{"software", "penumbra " PENUMBRA_VERSION},
                         {"exit_code", check::exit_code(outcomes)},
                         {"accept", accept_command},
                         {"checks", ordered_json::array()}};
    for (const check::CheckOutcome& outcome : outcomes)
        root["checks"].push_back(check_entry(outcome));
    return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace penumbra::cli
