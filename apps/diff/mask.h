#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace penumbra::diff {

// Which pixels count: those where an image of the display window's size is at least 0.5 in its
// first channel.
class Mask {
  public:
    // Throws InputError.
    explicit Mask(const std::filesystem::path& file);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    // Pixels beyond the mask do not count.
    [[nodiscard]] bool counts(int x, int y) const {
        return x >= 0 && y >= 0 && x < width_ && y < height_ &&
               pixels_[static_cast<std::size_t>(y) * width_ + x] != 0;
    }

  private:
    int width_ = 0, height_ = 0;
    std::vector<std::uint8_t> pixels_;
};

}  // namespace penumbra::diff
