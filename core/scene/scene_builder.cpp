#include "core/scene/scene_builder.h"

#include <algorithm>

#include "core/error.h"
#include "core/scene/merge_emitters.h"
#include "core/scene/polygon_soup.h"
#include "core/scene/read_obj.h"
#include "core/text_scan.h"

namespace penumbra {
namespace {

bool emits(const Material& material) {
    return material.emission.x > 0 || material.emission.y > 0 || material.emission.z > 0;
}

}  // namespace

void SceneBuilder::warn(std::string message) {
    auto& warnings = scene_.warnings;
    if (std::find(warnings.begin(), warnings.end(), message) == warnings.end())
        warnings.push_back(std::move(message));
}

void SceneBuilder::read_libraries(const std::filesystem::path& file,
                                  const std::vector<std::string>& names, ModelFile& model) {
    const std::filesystem::path folder = file.parent_path();
    const auto load_library = [&](const std::filesystem::path& library) {
        // The first definition of a name holds.
        for (MtlMaterial& m : read_mtl(library, files_, scene_.warnings))
            model.library.try_emplace(m.values.name, std::move(m));
    };
    for (const std::string& name : names) {
        if (const auto whole = files_.find(folder, name)) {
            load_library(*whole);
            continue;
        }
        // By the format's letter blanks separate several files.
        std::string_view rest = name;
        while (!rest.empty()) {
            const std::string_view word = take_word(rest);
            if (const auto part = files_.find(folder, word))
                load_library(*part);
            else
                warn(fmt::format("{}: the material library \"{}\" is missing", file.string(),
                                 printable(word)));
        }
    }
}

const SceneBuilder::ModelFile& SceneBuilder::load(const std::filesystem::path& file) {
    const std::string key = file.lexically_normal().generic_string();
    const auto [entry, is_new] = model_files_.try_emplace(key);
    ModelFile& model = entry->second;
    if (!is_new) return model;
    ObjFile obj = read_obj(file, files_);
    if (obj.soup.dropped_triangles > 0)
        warn(fmt::format("{}: {} triangles without area were dropped", file.string(),
                         obj.soup.dropped_triangles));
    model.mesh = static_cast<std::uint32_t>(scene_.meshes.size());
    model.slots = std::move(obj.slots);
    scene_.meshes.push_back(build_mesh(std::move(obj.soup)));
    read_libraries(file, obj.libraries, model);
    return model;
}

std::uint32_t SceneBuilder::make_material(const std::string& key, const std::string& name,
                                          const MtlMaterial* base) {
    const auto [entry, is_new] = materials_.try_emplace(key, 0u);
    if (!is_new) return entry->second;
    MtlMaterial material = base ? *base : MtlMaterial{};
    material.values.name = name;
    entries_.apply(name, material);
    used_entries_[name] = true;
    textures_.load_maps(material.maps, material.values);
    entry->second = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(std::move(material.values));
    return entry->second;
}

std::uint32_t SceneBuilder::material_of(const ModelFile& model, const std::string& slot,
                                        const std::optional<std::string>& material) {
    const auto found = model.library.find(slot);
    if (!slot.empty() && found != model.library.end())
        return make_material(fmt::format("{}/{}", model.mesh, slot), slot, &found->second);
    if (!slot.empty() && entries_.has(slot)) return make_material("/" + slot, slot, nullptr);
    if (material) return make_material("/" + *material, *material, nullptr);
    if (!slot.empty())
        warn(fmt::format("{}: the material \"{}\" is not defined; \"default\" is used",
                         scene_.meshes[model.mesh].name, printable(slot)));
    return make_material("/default", "default", nullptr);
}

void SceneBuilder::add_model(const std::filesystem::path& file, Placement placement) {
    const ModelFile& source = load(file);
    Model model;
    model.name = std::move(placement.name);
    model.mesh = source.mesh;
    model.transform = std::move(placement.transform);
    for (const std::string& slot : source.slots)
        model.materials.push_back(material_of(source, slot, placement.material));
    if (placement.material && !used_entries_.contains(*placement.material))
        warn(fmt::format("model \"{}\": all its faces have materials; \"{}\" is not used",
                         model.name, *placement.material));
    add_emitters(model, static_cast<std::uint32_t>(scene_.models.size()));
    scene_.models.push_back(std::move(model));
}

void SceneBuilder::add_emitters(const Model& model, std::uint32_t index) {
    const Mesh& mesh = scene_.meshes[model.mesh];
    for (std::size_t slot = 0; slot < model.materials.size(); ++slot) {
        const Material& material = scene_.materials[model.materials[slot]];
        if (!emits(material)) continue;
        std::vector<std::uint32_t> triangles;
        for (std::uint32_t i = 0; i < mesh.triangle_slots.size(); ++i)
            if (mesh.triangle_slots[i] == slot) triangles.push_back(i);
        for (const LightPolygon& polygon : merge_emitters(mesh, triangles))
            scene_.emitters.push_back({index, polygon, material.emission});
    }
}

void SceneBuilder::finish() {
    constexpr std::size_t kManyLights = 4096;
    if (scene_.emitters.size() > kManyLights)
        warn(fmt::format("{} emissive faces, each a light of its own: rendering will take long",
                         scene_.emitters.size()));
    for (const std::string& name : entries_.names())
        if (name != "default" && !used_entries_.contains(name))
            warn(fmt::format("materials.{}: no model uses a material of this name",
                             printable(name)));
}

}  // namespace penumbra
