#pragma once

#include "core/frame/surface.h"
#include "core/frame/tile.h"
#include "core/light/light_set.h"

// Bounds of lights over the surface blocks of a tile, for the culling.

namespace penumbra::shadow {

inline constexpr int kBlockSize = 16;  // pixels
inline constexpr int kBlocksPerRow = kTileSize / kBlockSize;
inline constexpr int kBlocks = kBlocksPerRow * kBlocksPerRow;

// What the hit pixels of each block have in common. Blocks without any have radius < 0.
struct alignas(64) BlockBounds {
    float center[3][kBlocks], radius[kBlocks];                // of the positions
    float normal_center[3][kBlocks], normal_radius[kBlocks];  // of the shading normals
    float albedo_low[3][kBlocks], albedo_high[3][kBlocks];    // of the diffuse lobe
    float specular[3][kBlocks];                               // largest glossy albedo
    float f0[3][kBlocks];  // largest reflectance at normal incidence
    float peak[kBlocks];   // largest glossy BRDF times cosine without Fresnel
};

struct BoundsJob {
    LightSetView lights;
    Vec3f eye;
    ConstSurfaceView surface;
    // lights.count x kBlocks: luminance of U at any hit pixel of the block, at most and at least.
    float* upper;
    float* lower;
};

}  // namespace penumbra::shadow

namespace penumbra::avx2 {
void bound_lights(const shadow::BoundsJob& job);
}
namespace penumbra::avx512 {
void bound_lights(const shadow::BoundsJob& job);
}
