#include "core/image/decode.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/image/exr_decode.h"
#include "core/image/file_checks.h"
#include "core/image/file_reader.h"
#include "core/image/radiance.h"
#include "core/image/stb_decode.h"

namespace penumbra::image {
namespace {

DecodedImage decode_checked(std::span<const std::uint8_t> content,
                            const std::filesystem::path& name, std::string_view format) {
    if (content.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw InputError(name, fmt::format("the {} file has over 2 GiB", format));
    }
    DecodedImage image;
    std::string reason;
    if (!decode_with_stb(content, image, reason)) {
        throw InputError(name, fmt::format("the {} file is damaged: {}", format, reason));
    }
    return image;
}

}  // namespace

DecodedImage decode_image(std::span<const std::uint8_t> content,
                          const std::filesystem::path& name) {
    if (content.empty()) throw InputError(name, "is empty, expected a PNG, JPEG, HDR or EXR image");
    if (is_png(content)) {
        check_png(content, name);
        return decode_checked(content, name, "PNG");
    }
    if (is_jpeg(content)) {
        check_jpeg(content, name);
        return decode_checked(content, name, "JPEG");
    }
    if (is_radiance(content)) return decode_radiance(content, name);
    if (is_exr(content)) return decode_exr(FileReader(content, name));
    throw InputError(name,
                     "is not an image of a known format, expected PNG, JPEG, Radiance HDR or EXR");
}

DecodedImage decode_image(const std::filesystem::path& file) {
    return decode_image(read_whole_file(file), file);
}

bool is_grey(const DecodedImage& image) {
    if (image.channels < 3) return true;
    constexpr float kTolerance = 1.0f / 32.0f;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const float r = image.sample(x, y, 0), g = image.sample(x, y, 1);
            const float b = image.sample(x, y, 2);
            if (!(std::max({r, g, b}) - std::min({r, g, b}) <= kTolerance)) return false;
        }
    }
    return true;
}

}  // namespace penumbra::image
