#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/cutout.h"
#include "core/scene/scene_view.h"
#include "raster/snapped.h"
#include "raster/texture_map.h"

// The scene as kernels read it: plain arrays and numbers, made once a frame.

namespace penumbra::raster {

struct InstanceTable {
    const float* positions;          // x y z of each vertex, world
    const float* normals;            // likewise
    const float* uvs;                // u v of each vertex, or null
    const std::int32_t* vertices;    // the three vertices of each triangle
    const std::uint16_t* slots;      // of each triangle
    const std::uint32_t* materials;  // of each slot
    const CutoutMap* cutouts;        // of each slot, or null if no slot has one
    const SnappedVertex* snapped;    // of each vertex
    std::int32_t vertex_count;
    Affine3f previous_from_current;
    bool flips_winding;
};

struct MaterialTable {
    Vec3f base_color, emission;
    float roughness, metallic, dielectric_f0;
    TextureMap base_color_map, roughness_map, metallic_map, normal_map;
};

// The vectors back the pointers; they are filled by make_tables and not changed while tiles run.
struct SceneTables {
    std::vector<InstanceTable> instances;
    std::vector<MaterialTable> materials;
    std::vector<CutoutMap> cutouts;
};

// All but InstanceTable::snapped, which is null.
void make_tables(const SceneView& scene, SceneTables& tables);

}  // namespace penumbra::raster
