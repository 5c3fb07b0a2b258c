#include "apps/cli/statistics_file.h"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "apps/renderer/renderer.h"
#include "apps/renderer/settings_table.h"
#include "apps/renderer/version.h"
#include "core/image/publish.h"

namespace penumbra::cli {
namespace {

using nlohmann::ordered_json;

ordered_json passes(const renderer::FrameStatistics& statistics) {
    ordered_json result;
    for (const renderer::PassInfo& info : renderer::kPasses)
        result[std::string(info.name)] = {
            {"seconds", statistics.passes[info.pass]},
            {"clock", info.scope == renderer::PassScope::kTile ? "all threads" : "wall"}};
    return result;
}

ordered_json frame_entry(const renderer::FrameReport& frame) {
    ordered_json entry = {{"frame", frame.frame}, {"path", frame.path}};
    switch (frame.outcome) {
        case renderer::FrameOutcome::kSkipped:
            entry["outcome"] = "skipped";
            return entry;
        case renderer::FrameOutcome::kFailed:
            entry["outcome"] = "failed";
            entry["error"] = frame.error;
            return entry;
        case renderer::FrameOutcome::kRendered:
            entry["outcome"] = "rendered";
    }
    const renderer::FrameStatistics& s = frame.statistics;
    entry["render_seconds"] = s.render_seconds;
    entry["write_seconds"] = s.write_seconds;
    entry["tiles_wall_seconds"] = s.tiles_wall_seconds;
    entry["passes"] = passes(s);
    entry["triangles"] = s.triangles;
    entry["shadow_rays"] = s.shadow_rays;
    entry["clamped_halves"] = s.clamped_halves;
    entry["non_finite_values"] = s.non_finite_values;
    return entry;
}

// Numbers as their shortest text, which as doubles of floats they would not have.
ordered_json json_of(const renderer::Number& setting, const auto& value) {
    return ordered_json::parse(text_of(setting, value));
}
ordered_json json_of(const renderer::Flag&, bool value) {
    return value;
}
ordered_json json_of(const auto& setting, const auto& value) {
    return text_of(setting, value);
}

// What was not said is left out.
ordered_json settings(const Scene& scene, const RenderOptions& options) {
    const renderer::ImageSettings image = renderer::completed(scene, options.image);
    ordered_json result;
    renderer::each_setting(image, options.execution, options.output,
                           [&](const auto& setting, const auto& value) {
                               if (!text_of(setting, value).empty())
                                   result[std::string(setting.name)] = json_of(setting, value);
                           });
    return result;
}

std::size_t peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

void write_statistics(const std::string& path, const Scene& scene, const RenderOptions& options,
                      const renderer::SequenceReport& report) {
    std::size_t dropped = 0;
    for (const Mesh& mesh : scene.meshes) dropped += mesh.dropped_triangles;
    ordered_json root = {{"software", std::string("penumbra ") + std::string(renderer::version())},
                         {"scene", options.scene.empty() ? "built-in" : options.scene},
                         {"settings", settings(scene, options)},
                         {"wall_seconds", report.wall_seconds},
                         {"peak_memory_bytes", peak_memory_bytes()},
                         {"dropped_triangles", dropped},
                         {"warnings", scene.warnings},
                         {"frames", ordered_json::array()}};
    for (const renderer::FrameReport& frame : report.frames)
        root["frames"].push_back(frame_entry(frame));
    image::write_file_atomically(
        path, root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace penumbra::cli
