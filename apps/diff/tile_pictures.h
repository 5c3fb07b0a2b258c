#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "apps/diff/tile_metrics.h"
#include "core/image/png.h"

namespace penumbra::diff {

// A tile as pictures: 8-bit RGB of both images, and the error map as 0 ... 255. The map is FLIP for
// colours (at least 0.08 where anything differs, so that it is seen) and the largest
// relative_difference() of the channels for everything else.
struct TilePictures {
    image::Picture reference, test;
    std::vector<std::uint8_t> heat;
};
[[nodiscard]] TilePictures draw_tile(const TileContext& context, const TileRect& tile);

// The colours of an error map: black, violet, red, yellow, white.
[[nodiscard]] image::Picture colour_map(const std::vector<std::uint8_t>& heat, int width,
                                        int height);

// A picture in the making, reduced by a power of two of at most 64 so that no side is above 4096.
class PictureCanvas {
  public:
    PictureCanvas(int width, int height);
    [[nodiscard]] int reduction() const { return reduction_; }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    // Colours are averaged over what one pixel stands for. Tiles may be placed at once.
    void place(const image::Picture& tile, int x0, int y0);
    [[nodiscard]] image::Picture take() { return std::move(picture_); }

  private:
    int reduction_, width_, height_;
    image::Picture picture_;
};

// The same for error maps, of which the largest value is kept. Tiles may be placed at once, on each
// other, too.
class HeatCanvas {
  public:
    // Of the pixels in the window; reduced as wished, or by a power of two so that no side is above
    // 4096.
    HeatCanvas(const image::Window& window, int reduction);
    explicit HeatCanvas(const image::Window& window);

    // A tile of a part whose data window begins at (x0, y0).
    void place(const std::vector<std::uint8_t>& tile, const TileRect& at, int x0, int y0);
    [[nodiscard]] image::Picture picture() const { return colour_map(heat_, width_, height_); }

  private:
    image::Window window_;
    int reduction_, width_, height_;
    std::vector<std::uint8_t> heat_;
};

}  // namespace penumbra::diff
