#pragma once

namespace penumbra {

// How the glossy light of core/light/lobe_ratio.h is taken. Errors: docs/methods.md.
enum class LobeAccuracy {
    kFast,   // lobe / D at one point of the light
    kExact,  // its mean over the light, as fine as the pixel needs it
};

}  // namespace penumbra
