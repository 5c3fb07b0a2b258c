#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/scene/input_files.h"
#include "core/scene/scene.h"

namespace penumbra {

// A texture that a material asks for.
struct MapRequest {
    std::filesystem::path file;
    TextureRequest request;
    bool height_if_grey = false;  // MTL's map_Bump: a normal map unless its channels are equal
    std::string problem;          // why there is no file: an error only if the map is used
};

struct MaterialMaps {
    std::optional<MapRequest> base_color, roughness, metallic, normal, opacity;
};

// Loads each texture once. Appends to a scene's textures and warnings.
class TextureSet {
  public:
    TextureSet(InputFiles& files, std::vector<Texture>& textures,
               std::vector<std::string>& warnings)
        : files_(files), textures_(textures), warnings_(warnings) {}

    // Index into the scene's textures.
    [[nodiscard]] int load(const MapRequest& request);

    // Fills the indices of a material from the requests that are there.
    void load_maps(const MaterialMaps& maps, Material& material);

  private:
    using Key = std::tuple<std::string, TextureKind, int, float, bool>;
    [[nodiscard]] LoadedTexture read(const MapRequest& request);

    InputFiles& files_;
    std::vector<Texture>& textures_;
    std::vector<std::string>& warnings_;
    std::map<Key, int> loaded_;
};

}  // namespace penumbra
