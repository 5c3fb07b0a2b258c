#pragma once

#include <cstddef>
#include <vector>

namespace penumbra::denoise {

// Memory for one worker of the denoiser's passes; holds nothing between calls.
class Scratch {
  public:
    // The passes' demand for frames whose planes are this many elements wide.
    explicit Scratch(int window_width);
    // 64-byte aligned.
    [[nodiscard]] float* data() { return lines_.front().values; }
    [[nodiscard]] std::size_t size() const { return lines_.size() * kPerLine; }

  private:
    static constexpr std::size_t kPerLine = 16;
    struct alignas(64) Line {
        float values[kPerLine];
    };
    std::vector<Line> lines_;
};

}  // namespace penumbra::denoise
