#include "apps/diff/mask.h"

#include <algorithm>

#include "core/error.h"
#include "core/image/decode.h"

namespace penumbra::diff {

Mask::Mask(const std::filesystem::path& file) {
    const image::DecodedImage image = image::decode_image(file);
    width_ = image.width;
    height_ = image.height;
    pixels_.resize(static_cast<std::size_t>(width_) * height_);
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x)
            pixels_[static_cast<std::size_t>(y) * width_ + x] = image.sample(x, y, 0) >= 0.5f;
    if (std::find(pixels_.begin(), pixels_.end(), 1) == pixels_.end())
        throw InputError(file, "is black: the mask leaves no pixel to compare");
}

}  // namespace penumbra::diff
