#pragma once

#include <optional>
#include <string>

#include "apps/renderer/aov.h"
#include "core/image/exr.h"

namespace penumbra::renderer {

// What becomes of the frames.
struct OutputSettings {
    std::string pattern;                 // "out/shot.####.exr"
    std::optional<std::string> preview;  // "out/shot.####.png"
    float exposure = 0;                  // EV of the previews
    AovSet aovs{Aov::kBeauty};
    image::ExrCompression compression = image::ExrCompression::kZip;
    bool float_precision = false;  // half AOVs as float
    bool resume = false;
};

}  // namespace penumbra::renderer
