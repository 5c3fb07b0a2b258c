#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/image/decode.h"
#include "core/scene/texture.h"

namespace penumbra {

// A texel before it is packed: red, green, blue, alpha in [0, 1], or a vector.
using WideTexel = std::array<float, 4>;

// The finest level of a texture, made row by row from a decoded image as the request says: sRGB
// curve, channel, opacity, normals, heights. So that a large image never exists in floats as a
// whole.
class TextureRows {
  public:
    // Throws InputError where the requested channel does not exist. Refers to both arguments.
    TextureRows(const image::DecodedImage& image, const TextureRequest& request,
                const std::string& name);

    // Each row is to be asked for once.
    void fill(int y, std::span<WideTexel> row);
    [[nodiscard]] std::size_t clamped_texels() const { return clamped_; }
    [[nodiscard]] bool image_has_alpha() const {
        return has_alpha_;
    }  // one that is not 1 everywhere
    [[nodiscard]] bool texels_have_alpha() const { return has_alpha_ && channel_[3] >= 0; }

  private:
    [[nodiscard]] float value(int x, int y, int channel) const;
    [[nodiscard]] WideTexel read(int x, int y);
    [[nodiscard]] float read_scalar(int x, int y);
    void read_heights();
    [[nodiscard]] WideTexel normal_from_heights(int x, int y) const;
    [[nodiscard]] float height(int x, int y) const;

    const image::DecodedImage& image_;
    const TextureRequest& request_;
    std::array<int, 4> channel_{};  // of the file, for red, green, blue, alpha; -1: none
    bool decodes_srgb_ = false;
    bool has_alpha_ = false;
    std::vector<float> heights_;
    std::size_t clamped_ = 0;
};

}  // namespace penumbra
