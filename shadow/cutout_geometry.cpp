#include "shadow/cutout_geometry.h"

namespace penumbra::shadow {
namespace {

constexpr std::uint32_t kOpaque = 0xFFFFFFFFu;

CutoutMap cutout_map(const Texture& texture) {
    const Texture::Level& level = texture.levels.front();
    // Texels are unsigned words, which the lanes gather as signed ones.
    const auto* const words = reinterpret_cast<const std::int32_t*>(texture.texels.data());
    return {words + level.offset, level.width, level.height};
}

// Per slot of the mesh: the index of its opacity map among `maps`, or kOpaque.
std::vector<std::uint32_t> maps_of_slots(const SceneView& view, const Instance& instance,
                                         std::vector<CutoutMap>& maps) {
    std::vector<std::uint32_t> indices;
    for (const std::uint32_t material : instance.materials) {
        const int texture = view.materials[material].opacity_map;
        const bool has_holes = texture != kNoTexture && !instance.mesh->uvs.empty();
        indices.push_back(has_holes ? static_cast<std::uint32_t>(maps.size()) : kOpaque);
        if (has_holes) maps.push_back(cutout_map(view.textures[static_cast<std::size_t>(texture)]));
    }
    return indices;
}

}  // namespace

bool CutoutGeometry::is_opaque_at(std::uint32_t index, const Vec3f& origin,
                                  const Vec3f& direction) const {
    const auto& [a, b, c] = triangles[index].vertex;
    const Vec2f triangle_uvs[3] = {uvs[a], uvs[b], uvs[c]};
    const auto triangle = relative_triangle(origin, positions[a], positions[b], positions[c]);
    return is_opaque<float>(maps[maps_of_triangles[index]], triangle, triangle_uvs, direction);
}

std::unique_ptr<CutoutSplit> split_cutouts(const SceneView& view, const Instance& instance,
                                           const Vec3f* positions) {
    auto split = std::make_unique<CutoutSplit>();
    const Mesh& mesh = *instance.mesh;
    split->opaque = mesh.triangles;
    CutoutGeometry& cutout = split->cutout;
    const std::vector<std::uint32_t> maps = maps_of_slots(view, instance, cutout.maps);
    if (cutout.maps.empty()) return split;
    cutout.positions = positions;
    cutout.uvs = mesh.uvs.data();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::uint32_t map = maps[mesh.triangle_slots[i]];
        if (map == kOpaque) {
            split->opaque_copy.push_back(mesh.triangles[i]);
        } else {
            cutout.triangles.push_back(mesh.triangles[i]);
            cutout.maps_of_triangles.push_back(map);
        }
    }
    split->opaque = split->opaque_copy;
    return split;
}

}  // namespace penumbra::shadow
