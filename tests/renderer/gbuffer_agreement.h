#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/scene/scene.h"

// The G-buffer against Embree's primary rays through the same pixel centres: visibility, depth and
// geometric normal, before the pass that draws visible lights over the surface.

namespace penumbra::tests {

// Where the two name different surfaces, that is excused if the pixel centre lies this close to an
// edge of one of the two triangles (in pixels; what the near plane leaves of them, double
// precision), or if both surfaces lie within this relative depth behind it.
inline constexpr double kEdgePixels = 0.01;
inline constexpr double kSameDepth = 1e-5;

// Tolerances where they name the same triangle, in multiples of what one rounding of a vertex
// relative to the eye (half an ulp of its distance from the eye) moves the plane's depth, or turns
// its normal.
inline constexpr double kDepthRoundings = 16;
inline constexpr double kNormalRoundings = 16;

struct Disagreement {
    int x, y;
    std::string what;  // both surfaces, for messages
};

struct Agreement {
    std::size_t pixels = 0;
    std::size_t covered = 0;     // ours shows a surface
    std::size_t agreeing = 0;    // same triangle, depth and normal, or nothing in both
    std::size_t near_edge = 0;   // excused
    std::size_t same_depth = 0;  // excused
    std::size_t triangle = 0, depth = 0, normal = 0;  // unexcused, by what differs first
    double worst_depth = 0, worst_normal = 0;         // of agreeing pixels, in roundings
    std::vector<Disagreement> examples;               // of the unexcused, the first few

    [[nodiscard]] std::size_t unexcused() const { return triangle + depth + normal; }
};

struct AgreementSettings {
    int width = 0, height = 0;
    int frame = 1;
    int threads = 1;
};

// Holes of cutouts are holes for the rays too: core/scene/cutout.h decides on both sides.
[[nodiscard]] Agreement compare_with_rays(const Scene& scene, const AgreementSettings& settings);

}  // namespace penumbra::tests
