#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

// Image files in: PNG, JPEG, Radiance HDR and OpenEXR, told apart by their content, not their name.

namespace penumbra::image {

// Larger images are refused before anything is allocated for their pixels.
inline constexpr int kMaxImageSide = 32768;
inline constexpr std::size_t kMaxDecodedBytes = std::size_t{1} << 31;

enum class SampleType {
    kUint8,   // display-coded (sRGB) if it is a colour; PNG and JPEG
    kUint16,  // PNG of 16 bits
    kFloat,   // scene-linear; Radiance HDR and OpenEXR
};

// Pixels as the file holds them. Interleaved, row 0 at the top, 1 to 4 channels: grey, grey +
// alpha, RGB, RGBA. Only the vector of `type` is filled.
struct DecodedImage {
    int width = 0;
    int height = 0;
    int channels = 0;
    SampleType type = SampleType::kUint8;
    std::vector<std::uint8_t> bytes;
    std::vector<std::uint16_t> words;
    std::vector<float> floats;

    [[nodiscard]] bool has_alpha() const { return channels == 2 || channels == 4; }
    [[nodiscard]] std::size_t sample_count() const {
        return static_cast<std::size_t>(width) * height * channels;
    }
    // A sample as a number: integers divided by their maximum, floats as they are. No curve
    // applied.
    [[nodiscard]] float sample(int x, int y, int channel) const {
        const std::size_t at = (static_cast<std::size_t>(y) * width + x) * channels + channel;
        if (type == SampleType::kUint8) return static_cast<float>(bytes[at]) / 255.0f;
        if (type == SampleType::kUint16) return static_cast<float>(words[at]) / 65535.0f;
        return floats[at];
    }
};

// Throws InputError where the file is missing, damaged, incomplete, too large or of another format;
// OutputError where the disk fails. An EXR gives its first part's R, G, B (and A), or Y (and A), or
// its only channel, placed in the display window.
[[nodiscard]] DecodedImage decode_image(const std::filesystem::path& file);

// The same from memory; `name` is for messages.
[[nodiscard]] DecodedImage decode_image(std::span<const std::uint8_t> content,
                                        const std::filesystem::path& name);

// Are the colour channels equal everywhere (within 1/32 of full scale: JPEG)? Such a map_Bump is a
// height map, not a normal map.
[[nodiscard]] bool is_grey(const DecodedImage& image);

}  // namespace penumbra::image
