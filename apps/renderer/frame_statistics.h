#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace penumbra::renderer {

// The passes of a frame, in their order. Those of the tiles are measured in seconds of all threads
// together, the others in wall-clock seconds.
enum class Pass {
    kEvaluate,   // scene at the frame's time, occluders
    kSetup,      // vertices to clip space, triangles to bins
    kRasterize,  // tiles, from here ...
    kResolve,
    kShade,  // U, visible lights
    kRays,   // shadow rays and their weights, sums
    kTrace,
    kDeposit,  // ... to here
    kNoise,    // frame passes
    kFilter,
};
inline constexpr int kPassCount = 10;
[[nodiscard]] std::string_view name(Pass pass);
[[nodiscard]] constexpr bool is_tile_pass(Pass pass) {
    return pass >= Pass::kRasterize && pass <= Pass::kDeposit;
}

struct PassSeconds {
    std::array<double, kPassCount> seconds{};
    double& operator[](Pass pass) { return seconds[static_cast<std::size_t>(pass)]; }
    double operator[](Pass pass) const { return seconds[static_cast<std::size_t>(pass)]; }
    PassSeconds& operator+=(const PassSeconds& other) {
        for (int i = 0; i < kPassCount; ++i) seconds[i] += other.seconds[i];
        return *this;
    }
};

struct FrameStatistics {
    PassSeconds passes;
    double tiles_wall_seconds = 0;  // of all tile passes together
    double render_seconds = 0;      // wall clock, without writing
    double write_seconds = 0;       // wall clock of encoding and writing, beside the next frame
    std::uint64_t shadow_rays = 0;
    std::uint64_t triangles = 0;
    std::uint64_t clamped_halves = 0;     // values beyond 65504 in half channels
    std::uint64_t non_finite_values = 0;  // a defect wherever it is not 0
};

}  // namespace penumbra::renderer
