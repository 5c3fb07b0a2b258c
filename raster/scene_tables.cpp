#include "raster/scene_tables.h"

#include <algorithm>

#include "core/bsdf/ggx.h"

namespace penumbra::raster {
namespace {

static_assert(sizeof(Vec3f) == 3 * sizeof(float) && sizeof(Vec2f) == 2 * sizeof(float));
static_assert(sizeof(Triangle) == 3 * sizeof(std::int32_t));
static_assert(sizeof(Texture::Level) == 3 * sizeof(std::int32_t));

const std::int32_t* words(const Texture& texture) {
    return reinterpret_cast<const std::int32_t*>(texture.texels.data());
}

TextureMap texture_map(const SceneView& scene, int index) {
    if (index == kNoTexture) return {};
    const Texture& texture = scene.textures[index];
    return {words(texture), &texture.levels.front().width,
            static_cast<std::int32_t>(texture.levels.size())};
}

CutoutMap cutout_map(const SceneView& scene, int index) {
    if (index == kNoTexture) return {};
    const Texture& texture = scene.textures[index];
    return {words(texture), texture.levels.front().width, texture.levels.front().height};
}

MaterialTable material_table(const SceneView& scene, const Material& material) {
    const float reflectance = (material.ior - 1) / (material.ior + 1);
    return {.base_color = material.base_color,
            .emission = material.emission,
            .roughness = material.roughness,
            .metallic = material.metallic,
            .dielectric_f0 = reflectance * reflectance,
            .base_color_map = texture_map(scene, material.base_color_map),
            .roughness_map = texture_map(scene, material.roughness_map),
            .metallic_map = texture_map(scene, material.metallic_map),
            .normal_map = texture_map(scene, material.normal_map)};
}

InstanceTable instance_table(const Instance& instance) {
    const Mesh& mesh = *instance.mesh;
    return {.positions = reinterpret_cast<const float*>(instance.positions.data()),
            .normals = reinterpret_cast<const float*>(instance.normals.data()),
            .uvs = mesh.uvs.empty() ? nullptr : reinterpret_cast<const float*>(mesh.uvs.data()),
            .vertices = reinterpret_cast<const std::int32_t*>(mesh.triangles.data()),
            .slots = mesh.triangle_slots.data(),
            .materials = instance.materials.data(),
            .cutouts = nullptr,
            .snapped = nullptr,
            .vertex_count = static_cast<std::int32_t>(mesh.positions.size()),
            .previous_from_current = instance.previous_from_current,
            .flips_winding = instance.flips_winding};
}

bool has_cutout(const SceneView& scene, const Instance& instance) {
    return std::ranges::any_of(instance.materials, [&](std::uint32_t material) {
        return scene.materials[material].opacity_map != kNoTexture;
    });
}

}  // namespace

void make_tables(const SceneView& scene, SceneTables& tables) {
    tables.materials.clear();
    for (const Material& material : scene.materials)
        tables.materials.push_back(material_table(scene, material));

    std::size_t slots = 0;
    for (const Instance& instance : scene.instances) slots += instance.materials.size();
    tables.cutouts.clear();
    tables.cutouts.reserve(slots);  // pointers into it stay valid
    tables.instances.clear();
    for (const Instance& instance : scene.instances) {
        InstanceTable table = instance_table(instance);
        if (has_cutout(scene, instance)) {
            table.cutouts = tables.cutouts.data() + tables.cutouts.size();
            for (const std::uint32_t material : instance.materials)
                tables.cutouts.push_back(cutout_map(scene, scene.materials[material].opacity_map));
        }
        tables.instances.push_back(table);
    }
}

}  // namespace penumbra::raster
