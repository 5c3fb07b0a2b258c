#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/input_files.h"
#include "core/scene/texture_set.h"

namespace penumbra {

// A material of an MTL file: values checked and in range, maps not loaded yet.
struct MtlMaterial {
    Material values;
    MaterialMaps maps;
};

// Reads an MTL file through tinyobjloader; appends what is understood but not drawn to `warnings`.
// Throws InputError with the line where a number is none or a map's file is missing.
[[nodiscard]] std::vector<MtlMaterial> read_mtl(const std::filesystem::path& file,
                                                InputFiles& files,
                                                std::vector<std::string>& warnings);

}  // namespace penumbra
