#pragma once

#include <algorithm>

// The denoiser's settings, and how far its passes look. All are relative: to local light, to view
// depth, to the size of a pixel. A scene in millimetres or a thousand times dimmer gives the same
// W.

namespace penumbra::denoise {

// How the variations along the lines through a pixel become one number. Heitz, Hill and McGuire
// (2018), eq. 29, take the mean; the ports of their supplement the maximum. Measured on straight
// penumbrae with 1, 4 and 16 samples per pixel, the mean's error is 20 % smaller where they are 4
// or 16 pixels wide, the same at 64, and 10 % larger at 200.
enum class LineRule { kMaximum, kMean };

inline constexpr int kMaxLineRadius = 15;
inline constexpr int kMaxFilterRadius = 16;

struct NoiseSettings {
    int radius = 10;          // of the lines, pixels: 2 ... kMaxLineRadius
    float full_noise = 1.5f;  // sqrt(variation / radius) that counts as E = 1
    LineRule rule = LineRule::kMean;
};

struct FilterSettings {
    int radius = 10;                // pixels: 1 ... kMaxFilterRadius
    float radius_per_noise = 1.5f;  // the Gaussian's radius is min(1, this * E) * radius
    float smallest_radius = 0.5f;   // pixels; up to here a pixel passes unchanged
    float normal_weight = 1.5f;  // a tap weighs 1 - this * (1 - cos^4 of the angle between normals)
    float plane_weight =
        3.0f;  // and (1 - this * sine of its direction's angle to the tangent plane)^2
};

// Pixels beyond a rectangle that a pass reads. A rectangle comes out the same for every window that
// holds it and these margins, as far as they lie in the frame.
struct Margin {
    int x = 0, y = 0;
};
constexpr Margin noise_margin(const NoiseSettings& noise) {
    return {noise.radius + 1, noise.radius + 1};  // the lines and the 3x3 box
}
constexpr Margin horizontal_filter_margin(const FilterSettings& filter) {
    return {filter.radius, 0};
}
constexpr Margin vertical_filter_margin(const FilterSettings& filter) {
    return {0, filter.radius};
}

// Of the whole chain, from S_N and U_N to the beauty.
constexpr Margin chain_margin(const NoiseSettings& noise, const FilterSettings& filter) {
    return {std::max(filter.radius, noise_margin(noise).x), filter.radius + noise_margin(noise).y};
}

}  // namespace penumbra::denoise
