#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "apps/renderer/renderer.h"
#include "core/scene/scene_view.h"
#include "shadow/bare_rays.h"

// What a frame works on, kept so that the machine's limits can be measured on the same.

namespace penumbra::bench {

struct Workload {
    SceneView view;
    std::vector<shadow::RayBatch> primary;  // per tile: one ray through each pixel's centre
    std::vector<shadow::RayBatch> shadow;   // per tile: exactly the frame's shadow rays
    // How many times as many there are as are kept: 1, or more where they would fill the memory;
    // then every so many-th tile is.
    double shadow_scale = 1;
    std::uint64_t pixels = 0, covered_pixels = 0;
    std::uint64_t vertices = 0, triangles = 0;
    std::uint64_t shadow_rays = 0;
    std::uint64_t shaded_pairs = 0;     // of a pixel and a light that it may see, at least
    std::uint64_t shaded_vertices = 0;  // of those lights
};

inline constexpr std::uint64_t kMemoryOfRays = std::uint64_t{2} << 30;

// Renders the frame once and keeps its rays. `memory` is what they may take, in bytes. Where
// `cancelled`, if any, becomes true, it returns early with a part of them.
[[nodiscard]] Workload record_workload(const Scene& scene, const renderer::ImageSettings& image,
                                       const renderer::ExecutionSettings& execution, int frame,
                                       std::uint64_t memory = kMemoryOfRays,
                                       const std::atomic<bool>* cancelled = nullptr);

}  // namespace penumbra::bench
