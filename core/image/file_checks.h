#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

// Inspections of PNG and JPEG files before a decoder sees them: right size, plausible for the
// number of bytes there are, whole to the end. They throw InputError.

namespace penumbra::image {

[[nodiscard]] bool is_png(std::span<const std::uint8_t> content);
[[nodiscard]] bool is_jpeg(std::span<const std::uint8_t> content);

// Chunk structure, checksums, IHDR ... IEND.
void check_png(std::span<const std::uint8_t> content, const std::filesystem::path& name);
// Marker segments up to the first scan, and an end marker after it. Baseline and progressive, 8
// bits.
void check_jpeg(std::span<const std::uint8_t> content, const std::filesystem::path& name);

// Throws where an image of this size is too large to be read.
void check_image_size(std::uint64_t width, std::uint64_t height, std::uint64_t bytes_per_pixel,
                      const std::filesystem::path& name);

}  // namespace penumbra::image
