#include "core/scene/texture_set.h"

#include "core/error.h"
#include "core/image/decode.h"

namespace penumbra {

LoadedTexture TextureSet::read(const MapRequest& map) {
    if (!files_.is_virtual() && !map.height_if_grey) {
        files_.note(map.file);
        return load_texture(map.file, map.request);
    }
    const std::string content = files_.read(map.file);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(content.data());
    const image::DecodedImage decoded = image::decode_image({bytes, content.size()}, map.file);
    TextureRequest request = map.request;
    if (map.height_if_grey && image::is_grey(decoded)) request.kind = TextureKind::kHeight;
    if (request.kind == TextureKind::kNormal) request.channel.reset();
    return make_texture(decoded, map.file.filename().string(), request);
}

int TextureSet::load(const MapRequest& map) {
    if (!map.problem.empty()) throw InputError(map.problem);
    const Key key{map.file.lexically_normal().generic_string(), map.request.kind,
                  map.request.channel.value_or(-1), map.request.relief, map.height_if_grey};
    if (const auto found = loaded_.find(key); found != loaded_.end()) return found->second;
    LoadedTexture loaded = read(map);
    if (loaded.clamped_texels > 0)
        warnings_.push_back(fmt::format("{}: {} texels outside [0, 1] were clamped",
                                        map.file.string(), loaded.clamped_texels));
    const int index = static_cast<int>(textures_.size());
    textures_.push_back(std::move(loaded.texture));
    loaded_.emplace(key, index);
    return index;
}

void TextureSet::load_maps(const MaterialMaps& maps, Material& material) {
    if (maps.base_color) material.base_color_map = load(*maps.base_color);
    if (maps.roughness) material.roughness_map = load(*maps.roughness);
    if (maps.metallic) material.metallic_map = load(*maps.metallic);
    if (maps.normal) material.normal_map = load(*maps.normal);
    if (maps.opacity) material.opacity_map = load(*maps.opacity);
}

}  // namespace penumbra
