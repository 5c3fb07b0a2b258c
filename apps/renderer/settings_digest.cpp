#include "apps/renderer/settings_digest.h"

#include <fmt/format.h>

#include "apps/renderer/builtin_scene.h"
#include "apps/renderer/settings_table.h"
#include "apps/renderer/version.h"
#include "core/scene/digest.h"

namespace penumbra::renderer {
namespace {

struct AllSettings {
    ImageSettings image;
    ExecutionSettings execution;
    OutputSettings output;
};

// What changes nothing beside the others gets one value, so that --resume does not ask for it. Not
// what only some AOV shows: without a filter, E still depends on the noise estimate's settings.
AllSettings without_idle_ones(AllSettings all) {
    if (all.image.reproducible) all.execution.trace_isa = ExecutionSettings{}.trace_isa;
    if (all.output.preview)
        all.output.preview = ".png";  // no paths
    else
        all.output.exposure = OutputSettings{}.exposure;
    return all;
}

std::string hash(const std::string& text) {
    return digest_of(text, VirtualFiles{}).hex();
}

}  // namespace

std::string describe_settings(const ImageSettings& image, const ExecutionSettings& execution,
                              const OutputSettings& output) {
    const AllSettings all = without_idle_ones({image, execution, output});
    std::string text;
    each_setting(all.image, all.execution, all.output, [&](const auto& setting, const auto& value) {
        const std::string said = text_of(setting, value);
        if (said.empty()) return;
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", setting.name, said);
    });
    return text;
}

std::string settings_digest(const Scene& scene, const std::string& settings) {
    const std::string scene_digest =
        scene.file.empty() ? builtin_scene_digest() : digest_of(scene).hex();
    return hash(fmt::format("penumbra {}\n{}\n{}", version(), scene_digest, settings));
}

std::string frame_digest(const std::string& digest, int frame) {
    return hash(fmt::format("{} frame {}", digest, frame));
}

}  // namespace penumbra::renderer
