#include "apps/renderer/settings_digest.h"

#include <fmt/format.h>

#include "apps/renderer/builtin_scene.h"
#include "apps/renderer/version.h"
#include "core/image/exr.h"
#include "core/scene/digest.h"

namespace penumbra::renderer {
namespace {

std::string_view name(Method method) {
    switch (method) {
        case Method::kRatio:
            return "ratio";
        case Method::kStochastic:
            return "stochastic";
        case Method::kUnshadowed:
            return "unshadowed";
    }
    return "";
}

std::string_view name(Denoise denoise) {
    return denoise == Denoise::kNoiseDriven ? "noise-driven" : "none";
}

std::string_view name_of_tracer(const ImageSettings& image, shadow::TraceIsa isa) {
    return image.reproducible ? "exact" : shadow::name(isa);  // exact: nothing depends on Embree
}

std::string describe_filter(const ImageSettings& image) {
    const denoise::NoiseSettings& n = image.noise;
    const denoise::FilterSettings& f = image.filter;
    return fmt::format(
        "noise {} radius {} full {}, filter radius {} gain {} smallest {} normal {} plane {}, ",
        n.rule == denoise::LineRule::kMaximum ? "maximum" : "mean", n.radius, n.full_noise,
        f.radius, f.radius_per_noise, f.smallest_radius, f.normal_weight, f.plane_weight);
}

std::string hash(const std::string& text) {
    return digest_of(text, VirtualFiles{}).hex();
}

}  // namespace

std::string describe_settings(const ImageSettings& image, const ExecutionSettings& execution,
                              const OutputSettings& output) {
    const PixelRect crop = image.crop.value_or(PixelRect{});
    std::string text = fmt::format(
        "method {}, size {}x{}, crop {},{},{},{}, spp {}, aa {}, denoise {}, seed {}, "
        "light-tolerance {}, trace-isa {}, precision {}, compression {}, aov",
        name(image.method), image.width, image.height, crop.x0, crop.y0, crop.x1, crop.y1,
        image.samples_per_pixel, image.passes, name(image.denoise), image.seed,
        image.light_tolerance, name_of_tracer(image, execution.trace_isa),
        output.float_precision ? "float" : "half", image::name(output.compression));
    if (image.denoise == Denoise::kNoiseDriven) text = describe_filter(image) + text;
    if (output.preview) text = fmt::format("preview at {} EV, ", output.exposure) + text;
    for (const AovInfo& aov : aov_table())
        if (output.aovs.contains(aov.aov)) text += fmt::format(" {}", aov.name);
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
