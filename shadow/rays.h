#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/frame/frame_context.h"
#include "core/frame/surface.h"
#include "core/frame/tile.h"
#include "core/scene/scene_view.h"

// Shadow rays of one sample of one light, one ray per pixel of a tile, and what each of them is
// worth.

namespace penumbra::shadow {

inline constexpr int kTilePixels = kTileSize * kTileSize;

// One worker's memory for the rays of a tile. Allocated once; generate_rays, trace and accumulate
// pass it along. Ray and weight planes are kTileSize wide, row by row.
struct RayScratch {
    RayScratch();

    // Written by generate_rays. A ray runs from `origin` to `origin + direction * range`; range < 1
    // ends short of the light. Only the bits in `active` (one per pixel, one word per row) are
    // rays.
    Plane3<float> origin, direction;
    Plane<float> range;
    Plane3<float>
        weight;  // BRDF cosine radiance / density, over the number of samples; 0 if inactive
    std::array<std::uint64_t, kTileSize> active{};
    [[nodiscard]] std::uint64_t count_active() const;

    // Written by trace: whether the light is reached; bits of inactive pixels are 0.
    std::array<std::uint64_t, kTileSize> visible{};

    // The active rays, packed: what Embree sees.
    struct Packed {
        Plane<float> origin_x, origin_y, origin_z, direction_x, direction_y, direction_z;
        Plane<float> near_limit;  // 0
        Plane<float> far_limit;   // -infinity once occluded
    } packed;
};

// What is shaded: a tile's surface, seen from the eye.
struct RayInputs {
    FrameContext frame;
    Tile tile;
    Vec3f eye;
    ConstSurfaceView surface;
    std::span<const float> offset_scales;  // Occluders::offset_scales()
};

// Sample `index` of `count` (1 to 64) of one light. `light` numbers it within the scene's lights
// and selects its random numbers.
struct LightSample {
    LightSetView lights;
    std::uint32_t light = 0;
    int index = 0;
    int count = 1;
};

// Chooses a point of the light for every pixel: uniform in the solid angle of the part above the
// horizon of the shading normal; of more than 4 samples the last quarter follows GGX visible
// normals instead, and both kinds are weighted by the balance heuristic. Their sum estimates the
// integral of BRDF cosine radiance over the light. No ray where that is 0: nothing is hit, the
// light faces away or lies below the horizon, a BRDF sample misses it.
void generate_rays(const RayInputs& inputs, const LightSample& sample, RayScratch& scratch);

}  // namespace penumbra::shadow
