#include "core/image/stb_decode.h"

#include <algorithm>
#include <memory>

// Two formats and no files: every decoder that is not compiled in cannot be attacked.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_MAX_DIMENSIONS 32768
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wshadow"
#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#endif
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace penumbra::image {
namespace {

struct Free {
    void operator()(void* memory) const { stbi_image_free(memory); }
};

}  // namespace

bool decode_with_stb(std::span<const std::uint8_t> content, DecodedImage& image,
                     std::string& reason) {
    const int size = static_cast<int>(content.size());
    int width = 0, height = 0, channels = 0;
    const bool deep = stbi_is_16_bit_from_memory(content.data(), size) != 0;
    const std::unique_ptr<void, Free> pixels(
        deep ? static_cast<void*>(
                   stbi_load_16_from_memory(content.data(), size, &width, &height, &channels, 0))
             : static_cast<void*>(
                   stbi_load_from_memory(content.data(), size, &width, &height, &channels, 0)));
    if (pixels == nullptr) {
        const char* failure = stbi_failure_reason();
        reason = failure != nullptr ? failure : "unknown damage";
        return false;
    }
    image.width = width;
    image.height = height;
    image.channels = channels;
    image.type = deep ? SampleType::kUint16 : SampleType::kUint8;
    const std::size_t count = image.sample_count();
    if (deep) {
        const auto* words = static_cast<const std::uint16_t*>(pixels.get());
        image.words.assign(words, words + count);
    } else {
        const auto* bytes = static_cast<const std::uint8_t*>(pixels.get());
        image.bytes.assign(bytes, bytes + count);
    }
    return true;
}

}  // namespace penumbra::image
