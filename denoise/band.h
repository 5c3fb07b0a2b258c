#pragma once

#include "core/error.h"
#include "denoise/frame_window.h"

namespace penumbra::denoise {

// A band as elements of the planes, its right end rounded up to whole blocks.
inline PixelRect band_elements(const FrameWindow& frame, const PixelRect& band) {
    PENUMBRA_ASSERT((band.x0 - frame.window.x0) % kBlock == 0 && band.x0 >= frame.window.x0 &&
                        band.y0 >= frame.window.y0 && band.x1 <= frame.window.x1 &&
                        band.y1 <= frame.window.y1,
                    "band {},{} - {},{} in window {},{} - {},{}", band.x0, band.y0, band.x1,
                    band.y1, frame.window.x0, frame.window.y0, frame.window.x1, frame.window.y1);
    const int width = (band.width() + kBlock - 1) / kBlock * kBlock;
    const int x0 = band.x0 - frame.window.x0;
    return {x0, band.y0 - frame.window.y0, x0 + width, band.y1 - frame.window.y0};
}

// The pixels that exist, as elements of the planes.
inline PixelRect existing_elements(const FrameWindow& frame) {
    const PixelRect pixels = frame.pixels();
    return {pixels.x0 - frame.window.x0, pixels.y0 - frame.window.y0, pixels.x1 - frame.window.x0,
            pixels.y1 - frame.window.y0};
}

}  // namespace penumbra::denoise
