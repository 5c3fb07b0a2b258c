#pragma once

#include "denoise/estimator.h"

namespace penumbra::renderer {

enum class Method {
    kRatio,       // emission + U * W, W = S_N / U_N (Heitz, Hill and McGuire 2018)
    kStochastic,  // emission + S_N: plain Monte Carlo with the same samples
    kUnshadowed,  // emission + U
};

enum class Denoise { kNoiseDriven, kNone };

// What a method needs of a frame, and how it ends: all that the passes know of methods.
struct Plan {
    Method method;
    bool needs_occluders;
    bool needs_rays;               // S_N and U_N; without them nothing is noisy, or filtered
    denoise::Estimator estimator;  // makes the picture of U, S_N and U_N
    denoise::NoiseOf noise_of;     // what the filter's width follows
    Denoise denoise;               // where the user does not say
};

[[nodiscard]] const Plan& plan_of(Method method);

}  // namespace penumbra::renderer
