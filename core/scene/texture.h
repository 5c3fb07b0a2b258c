#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace penumbra {

// A mip chain of scene-linear RGBA texels in [0, 1], 16 bits a channel: enough for the darkest steps
// of 8-bit sRGB, and two 32-bit gathers a texel. Texel (x, y) of a level with width w lies at
// texels[offset + 2 * (y * w + x)], red | green << 16, followed by blue | alpha << 16. Row 0 is the
// image's top. Coordinates repeat.
struct Texture {
    struct Level {
        int width, height;
        std::int32_t offset;  // into `texels`, counted in 32-bit words
    };
    std::string name;
    std::vector<Level> levels;  // halving to 1 x 1, each the box filter of the one before; at most 16
    std::vector<std::uint32_t> texels;  // fewer than 2^31 words
};

}  // namespace penumbra
