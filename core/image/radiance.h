#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "core/image/decode.h"

namespace penumbra::image {

[[nodiscard]] bool is_radiance(std::span<const std::uint8_t> content);

// Radiance HDR ("Radiance file formats", G. Ward): RGBE, flat or run-length coded either way, rows
// top down. The header's EXPOSURE is not applied, as in other readers. Throws InputError.
[[nodiscard]] DecodedImage decode_radiance(std::span<const std::uint8_t> content,
                                           const std::filesystem::path& name);

}  // namespace penumbra::image
