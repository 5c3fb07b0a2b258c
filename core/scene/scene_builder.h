#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "core/json/node.h"
#include "core/scene/input_files.h"
#include "core/scene/read_mtl.h"
#include "core/scene/scene.h"
#include "core/scene/texture_set.h"

namespace penumbra {

// The scene file's `materials`, checked: what its entries say beyond a base.
class MaterialEntries {
  public:
    // `document` is the scene file's root.
    void read(const json::Node& document, const InputFiles& files);

    [[nodiscard]] bool has(std::string_view name) const;
    // Lays an entry over a base: fields that it has replace the base's.
    void apply(const std::string& name, MtlMaterial& base) const;
    [[nodiscard]] std::vector<std::string> names() const;

  private:
    using Change = std::function<void(MtlMaterial&)>;
    std::map<std::string, std::vector<Change>, std::less<>> entries_;
};

// Puts models and what belongs to them into a scene.
class SceneBuilder {
  public:
    SceneBuilder(Scene& scene, InputFiles& files, MaterialEntries entries)
        : scene_(scene),
          files_(files),
          entries_(std::move(entries)),
          textures_(files, scene.textures, scene.warnings) {}

    // Where it stands, and the material of faces that have none.
    struct Placement {
        std::string name;
        TransformTrack transform;
        std::optional<std::string> material;
    };
    // A file that several models use is read once.
    void add_model(const std::filesystem::path& file, Placement placement);

    // Once all models are in: warns of what is unused.
    void finish();

    [[nodiscard]] const MaterialEntries& entries() const { return entries_; }

  private:
    struct ModelFile {
        std::uint32_t mesh = 0;
        std::vector<std::string> slots;
        std::map<std::string, MtlMaterial> library;
    };
    const ModelFile& load(const std::filesystem::path& file);
    void read_libraries(const std::filesystem::path& file, const std::vector<std::string>& names,
                        ModelFile& model);
    [[nodiscard]] std::uint32_t material_of(const ModelFile& model, const std::string& slot,
                                            const std::optional<std::string>& material);
    [[nodiscard]] std::uint32_t make_material(const std::string& key, const std::string& name,
                                              const MtlMaterial* base);
    void add_emitters(const Model& model, std::uint32_t index);
    void warn(std::string message);  // once

    Scene& scene_;
    InputFiles& files_;
    MaterialEntries entries_;
    TextureSet textures_;
    std::map<std::string, ModelFile> model_files_;  // by normal path
    std::map<std::string, std::uint32_t> materials_;
    std::map<std::string, bool> used_entries_;
};

}  // namespace penumbra
