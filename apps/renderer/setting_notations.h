#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/renderer/aov.h"
#include "apps/renderer/settings.h"
#include "core/image/exr.h"

// How settings are written that are neither a word nor a number, and words that other tables list
// (setting.h). Readers throw InputError that names the option.

namespace penumbra::renderer {

// "960x540"
void read_size(std::string_view text, ImageSettings& image);
[[nodiscard]] std::string print_size(const ImageSettings& image);

// "X0,Y0,X1,Y1"
void read_crop(std::string_view text, std::optional<PixelRect>& crop);
[[nodiscard]] std::string print_crop(const std::optional<PixelRect>& crop);

// "beauty,Z,N"
void read_aovs(std::string_view text, AovSet& aovs);
[[nodiscard]] std::string print_aovs(const AovSet& aovs);
[[nodiscard]] std::vector<std::string> aov_words();

[[nodiscard]] std::vector<std::pair<std::string_view, image::ExrCompression>> compression_words();

// "out/shot.####.png"
void read_preview(std::string_view text, std::optional<std::string>& preview);
[[nodiscard]] std::string print_preview(const std::optional<std::string>& preview);

}  // namespace penumbra::renderer
