#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/image/plane.h"

// Pictures for people: tone-mapped 8-bit PNG.

namespace penumbra::image {

// Interleaved 8-bit sRGB, row 0 at the top, 3 (RGB) or 4 (RGBA, alpha not premultiplied) channels.
struct Picture {
    int width = 0;
    int height = 0;
    int channels = 3;
    std::vector<std::uint8_t> bytes;
};

// From scene-linear x' = x * 2^exposure, per channel:
//   kShoulder  y = x' up to 0.8, above that 0.8 + 0.2 t / (1 + t) with t = (x' - 0.8) / 0.2:
//   mid-tones as
//              every viewer shows them, highlights roll off and keep their texture (slope
//              continuous)
//   kClip      y = min(x', 1): what a viewer without a tone curve shows
// then the sRGB curve, rounded to the nearest of 256 steps. NaN becomes magenta: it must be seen.
enum class ToneCurve { kShoulder, kClip };
struct ToneMapping {
    float exposure_ev = 0;
    ToneCurve curve = ToneCurve::kShoulder;
};
[[nodiscard]] Picture tone_map(const PlaneView3<const float>& rgb, int width, int height,
                               const ToneMapping& mapping);

// Lossless; tuned for speed (a 1080p preview in a few tens of milliseconds), not for size.
[[nodiscard]] std::vector<std::uint8_t> encode_png(const Picture& picture);

// encode_png, then write_file_atomically.
void write_png(const std::filesystem::path& file, const Picture& picture);

}  // namespace penumbra::image
