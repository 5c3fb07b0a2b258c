#include <algorithm>
#include <array>

#include "core/bsdf/ggx.h"
#include "core/error.h"
#include "core/scene/scene_builder.h"

namespace penumbra {
namespace {

// null takes a map away that the MTL gives.
std::optional<MapRequest> read_map(const json::Node& node, TextureKind kind,
                                   const InputFiles& files) {
    if (node.is_null()) return std::nullopt;
    const std::string& name = node.text();
    const auto found = files.find(node.file().parent_path(), name);
    if (!found) node.fail(fmt::format("no such file: {}", node.shown()));
    MapRequest map;
    map.file = *found;
    map.request.kind = kind;
    return map;
}

struct MapField {
    const char* key;
    TextureKind kind;
    std::optional<MapRequest> MaterialMaps::*field;
};
constexpr std::array kMaps{
    MapField{"base_color_map", TextureKind::kColor, &MaterialMaps::base_color},
    MapField{"roughness_map", TextureKind::kData, &MaterialMaps::roughness},
    MapField{"metallic_map", TextureKind::kData, &MaterialMaps::metallic},
    MapField{"normal_map", TextureKind::kNormal, &MaterialMaps::normal},
    MapField{"opacity_map", TextureKind::kOpacity, &MaterialMaps::opacity}};

using Change = std::function<void(MtlMaterial&)>;

std::vector<Change> read_entry(const json::Node& node, const InputFiles& files) {
    node.allow({"base_color", "roughness", "metallic", "ior", "emission", "base_color_map",
                "roughness_map", "metallic_map", "normal_map", "opacity_map"});
    std::vector<Change> changes;
    const auto number = [&](const char* key, json::Range range, float Material::*field) {
        if (const auto value = node.find(key))
            changes.push_back([field, x = static_cast<float>(value->number(range))](
                                  MtlMaterial& m) { m.values.*field = x; });
    };
    const auto color = [&](const char* key, json::Range range, Vec3f Material::*field) {
        if (const auto value = node.find(key))
            changes.push_back(
                [field, c = value->vector(range)](MtlMaterial& m) { m.values.*field = c; });
    };
    color("base_color", json::kUnit, &Material::base_color);
    color("emission", json::kNonNegative, &Material::emission);
    number("roughness", json::kUnit, &Material::roughness);
    number("metallic", json::kUnit, &Material::metallic);
    number("ior", {1.0001, 100}, &Material::ior);
    for (const MapField& map : kMaps)
        if (const auto value = node.find(map.key))
            changes.push_back([field = map.field, request = read_map(*value, map.kind, files)](
                                  MtlMaterial& m) { m.maps.*field = request; });
    return changes;
}

}  // namespace

void MaterialEntries::read(const json::Node& document, const InputFiles& files) {
    const auto all = document.find("materials");
    if (!all) return;
    for (std::size_t i = 0; i < all->member_count(); ++i) {
        const auto [name, node] = all->member(i);
        entries_[name] = read_entry(node, files);
    }
}

bool MaterialEntries::has(std::string_view name) const {
    return entries_.find(name) != entries_.end();
}

void MaterialEntries::apply(const std::string& name, MtlMaterial& base) const {
    const auto found = entries_.find(name);
    if (found == entries_.end()) return;
    for (const Change& change : found->second) change(base);
    base.values.roughness = std::max(base.values.roughness, kMinimumRoughness);
}

std::vector<std::string> MaterialEntries::names() const {
    std::vector<std::string> result;
    for (const auto& [name, changes] : entries_) result.push_back(name);
    return result;
}

}  // namespace penumbra
