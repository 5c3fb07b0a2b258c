#include "apps/renderer/jitter.h"

#include <cmath>

namespace penumbra::renderer {
namespace {

// Position of the pass's sample in the pixel relative to its centre, in [-0.5, 0.5).
float offset(int pass, double step) {
    const double position = 0.5 + pass * step;
    return static_cast<float>(position - std::floor(position) - 0.5);
}

}  // namespace

void jitter(const Camera& camera, int pass, int passes, Camera& jittered) {
    constexpr double kPlasticNumber = 1.32471795724474602596;
    jittered = camera;
    if (passes == 1) return;
    // Sampling right of a pixel's centre is moving the picture to the left.
    jittered.center_x -= offset(pass, 1 / kPlasticNumber);
    jittered.center_y -= offset(pass, 1 / (kPlasticNumber * kPlasticNumber));
}

}  // namespace penumbra::renderer
