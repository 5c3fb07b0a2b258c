#pragma once

#include <filesystem>
#include <string_view>

#include "core/scene/input_files.h"
#include "core/scene/scene.h"

namespace penumbra {

// Reads a scene file (.json) or a model alone (.obj) with everything it names, checked. A model
// alone gets a camera that frames it, and a light unless it has emissive faces. Throws InputError
// with the file and the place in it, OutputError where the disk fails.
[[nodiscard]] Scene read_scene(const std::filesystem::path& file);

// A scene file that is at hand as text, its models and textures in `files`, by the names it uses.
[[nodiscard]] Scene read_scene_text(std::string_view text, const VirtualFiles& files);

}  // namespace penumbra
