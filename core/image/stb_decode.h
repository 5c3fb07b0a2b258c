#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/image/decode.h"

// The only user of stb_image: PNG and JPEG whose headers were inspected already (file_checks.h).

namespace penumbra::image {

// False, with stb's reason in `reason`, where the content is damaged.
[[nodiscard]] bool decode_with_stb(std::span<const std::uint8_t> content, DecodedImage& image,
                                   std::string& reason);

}  // namespace penumbra::image
