#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "apps/renderer/frame_statistics.h"
#include "apps/renderer/method.h"
#include "core/frame/tile.h"
#include "core/light/lobe_accuracy.h"
#include "core/parallel/tiles.h"
#include "core/profile/profile.h"
#include "core/simd/isa.h"
#include "denoise/settings.h"
#include "shadow/occluders.h"
#include "shadow/trace.h"

namespace penumbra::renderer {

// What the pixels depend on, beside the scene.
struct ImageSettings {
    int width = 0, height = 0;      // 0: the scene's
    std::optional<PixelRect> crop;  // inside the frame
    Method method = Method::kRatio;
    std::optional<Denoise> denoise;  // unset: the method's own
    int samples_per_pixel = 0;       // shadow rays per light and pixel, 1 to 64; 0: the scene's
    int passes = 1;                  // --aa: jittered passes, 1 to 256
    LobeAccuracy unshadowed = LobeAccuracy::kExact;  // of the glossy part of U
    denoise::NoiseSettings noise;
    denoise::FilterSettings filter;
    std::uint32_t seed = 0;
    float light_tolerance =
        1.0f / 1024;            // the share that culled lights may add up to; 0 culls none
    bool reproducible = false;  // shadow rays are settled exactly: equal bits on all processors
};

// Called with the rays of a tile, one light and one sample, before they are traced: from any worker
// at any time, but with one tile from one worker.
using RayObserver = std::function<void(const Tile& tile, const shadow::RayScratch& rays)>;

// Called at the end of each pass of a tile, within its time, from any worker: what makes a pass
// slower, to try those who say that it is.
using PassObserver = std::function<void(Pass pass)>;

// What no pixel depends on.
struct ExecutionSettings {
    int threads = 0;  // 0: what the machine allows
    std::optional<simd::Isa> isa;
    shadow::TraceIsa trace_isa =
        shadow::TraceIsa::kAvx2;  // others: one ray in a million may differ
    parallel::TileOrder tile_order{.kind = parallel::TileOrder::Kind::kMorton};
    shadow::Visibility visibility = shadow::Visibility::kTraced;  // others: for tests
    profile::Profile* profile = nullptr;   // where every frame's slices go, if anywhere
    const RayObserver* on_rays = nullptr;  // called if not null
    const PassObserver* on_pass = nullptr;
};

}  // namespace penumbra::renderer
