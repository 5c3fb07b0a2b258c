#pragma once

namespace penumbra {

// How the glossy light of core/light/lobe_ratio.h is taken. Errors: docs/methods.md.
enum class LobeAccuracy {
    kFast,   // as good as the eye needs it in most frames
    kExact,  // the true BRDF's integral
};

}  // namespace penumbra
