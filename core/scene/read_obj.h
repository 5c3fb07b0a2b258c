#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/input_files.h"
#include "core/scene/polygon_soup.h"

namespace penumbra {

// A Wavefront OBJ file: its triangles and the names it uses.
struct ObjFile {
    PolygonSoup soup;
    std::vector<std::string> slots;      // material names by slot; "" for faces without a material
    std::vector<std::string> libraries;  // of mtllib, as written
};

// Reads and checks an OBJ file through tinyobjloader: every number finite, every index within what
// is defined before its use. Polygons are cut into triangles; those without area are dropped and
// counted. Throws InputError with the line.
[[nodiscard]] ObjFile read_obj(const std::filesystem::path& file, InputFiles& files);

}  // namespace penumbra
