#pragma once

#include <algorithm>

#include "core/frame/tile.h"

namespace penumbra::denoise {

// Bands and blocks of the passes start at multiples of this many pixels; what is chosen per block
// is chosen for the same pixels whatever the number of lanes.
inline constexpr int kBlock = 16;

// Which part of the frame the planes hold. Element (0, 0) of every plane is pixel (window.x0,
// window.y0) of the frame, multiples of kTileSize. The window may reach beyond the frame, as tiles
// do.
struct FrameWindow {
    int width = 0, height = 0;  // the full frame, whatever the crop
    PixelRect window;

    // The pixels that exist: in the frame and in the planes.
    [[nodiscard]] PixelRect pixels() const {
        return {std::max(window.x0, 0), std::max(window.y0, 0), std::min(window.x1, width),
                std::min(window.y1, height)};
    }
};

}  // namespace penumbra::denoise
