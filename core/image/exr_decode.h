#pragma once

#include "core/image/decode.h"
#include "core/image/file_reader.h"

namespace penumbra::image {

[[nodiscard]] bool is_exr(std::span<const std::uint8_t> content);

// An EXR file as a picture: R G B (A), or Y (A), of the root or else of the first layer that has
// them, or the only channel; placed in the display window, black outside the data window.
[[nodiscard]] DecodedImage decode_exr(const FileReader& file);

}  // namespace penumbra::image
