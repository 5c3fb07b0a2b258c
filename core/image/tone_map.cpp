#include <cmath>

#include "core/image/png.h"
#include "core/image/srgb.h"
#include "core/math/elementary.h"

namespace penumbra::image {
namespace {

constexpr float kKnee = 0.8f;

// A rational curve instead of an exponential: the same bits on every machine.
float apply_curve(float x, ToneCurve curve) {
    if (curve == ToneCurve::kClip || !(x > kKnee)) return x;
    if (std::isinf(x)) return 1;
    const float t = (x - kKnee) / (1 - kKnee);
    return kKnee + (1 - kKnee) * (t / (1 + t));
}

}  // namespace

Picture tone_map(const PlaneView3<const float>& rgb, int width, int height,
                 const ToneMapping& mapping) {
    Picture picture{width, height, 3, {}};
    picture.bytes.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    const float gain = exp2(mapping.exposure_ev);
    std::uint8_t* to = picture.bytes.data();
    for (int y = 0; y < height; ++y) {
        const float* row[] = {rgb[0].row(y), rgb[1].row(y), rgb[2].row(y)};
        for (int x = 0; x < width; ++x, to += 3) {
            for (int c = 0; c < 3; ++c) {
                to[c] = srgb8_from_linear(apply_curve(row[c][x] * gain, mapping.curve));
            }
            if (std::isnan(row[0][x]) || std::isnan(row[1][x]) || std::isnan(row[2][x])) {
                to[0] = to[2] = 255;
                to[1] = 0;
            }
        }
    }
    return picture;
}

}  // namespace penumbra::image
