#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/frame/tile.h"
#include "core/light/lobe_accuracy.h"
#include "core/scene/scene.h"

// The unshadowed light of a frame twice, on the same G-buffer: the analytic U, and the Monte Carlo
// U_N of the frame's own shadow rays, none of which is traced. Made by the renderer's passes.

namespace penumbra::tests {

// As many as a frame may have; the last quarter follow the BRDF.
inline constexpr int kRaysPerSet = 64;

struct UnshadowedSettings {
    int width = 0, height = 0;      // of the full frame
    std::optional<PixelRect> crop;  // its top left is a tile's; by default the whole frame
    int frame = 1;
    int batches = 2;  // independent of each other
    // Per batch and pixel, shared by the lights of the pixel's tile: as many whole sets of
    // kRaysPerSet each as it gives, but at least one.
    int rays_per_batch = kRaysPerSet;
    std::uint32_t seed = 0;  // sets of rays are frames of consecutive seeds
    int threads = 2;
    LobeAccuracy accuracy = LobeAccuracy::kExact;
};

// Planes begin at the crop's top left.
struct UnshadowedFrame {
    int width = 0, height = 0;
    Plane3<float> analytic;              // U
    std::vector<Plane3<float>> sampled;  // U_N of each batch
    Plane<float> cos_view;               // n.v, of the shading normal
    Plane<std::uint32_t> material;       // kNothing where there is no surface
};

[[nodiscard]] UnshadowedFrame render_unshadowed(const Scene& scene,
                                                const UnshadowedSettings& settings);

}  // namespace penumbra::tests
