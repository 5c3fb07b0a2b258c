#pragma once

#include <array>
#include <cstdint>

#include "apps/renderer/pass_table.h"

namespace penumbra::renderer {

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
