#include "core/scene/texture_rows.h"

#include "core/error.h"
#include "core/image/srgb.h"
#include "core/math/vec.h"

namespace penumbra {
namespace {

// The file's channel for red, green, blue (0, 1, 2) or alpha (3); -1: it has none.
int file_channel(const image::DecodedImage& image, int wanted) {
    if (wanted < 0 || wanted > 3) return -1;
    if (wanted == 3) return image.has_alpha() ? image.channels - 1 : -1;
    return image.channels < 3 ? 0 : wanted;
}

bool has_holes(const image::DecodedImage& image) {
    if (!image.has_alpha()) return false;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (image.sample(x, y, image.channels - 1) != 1.0f) return true;
        }
    }
    return false;
}

// Clamps what 16-bit texels cannot hold; NaN becomes 0.
float to_unit(float value, bool& clamped) {
    if (value >= 0 && value <= 1) return value;
    clamped = true;
    return value > 1 ? 1.0f : 0.0f;
}

}  // namespace

TextureRows::TextureRows(const image::DecodedImage& image, const TextureRequest& request,
                         const std::string& name)
    : image_(image), request_(request), has_alpha_(has_holes(image)) {
    for (int c = 0; c < 4; ++c) channel_[c] = file_channel(image, c);
    if (request.channel) {
        const int only = file_channel(image, *request.channel);
        if (only < 0) {
            throw InputError(name, fmt::format("channel {} is asked for, but the image has {}",
                                               *request.channel, image.channels));
        }
        channel_ = {only, only, only, -1};
    }
    decodes_srgb_ = request.kind == TextureKind::kColor && image.type == image::SampleType::kUint8;
    if (request.kind == TextureKind::kHeight) read_heights();
}

float TextureRows::value(int x, int y, int channel) const {
    const bool is_alpha = image_.has_alpha() && channel == image_.channels - 1;
    if (!decodes_srgb_ || is_alpha) return image_.sample(x, y, channel);
    const std::size_t pixel = static_cast<std::size_t>(y) * image_.width + x;
    const std::uint8_t code = image_.bytes[pixel * image_.channels + channel];
    return static_cast<float>(image::linear16_from_srgb8()[code]) / 65535.0f;
}

WideTexel TextureRows::read(int x, int y) {
    bool clamped = false;
    WideTexel texel{0, 0, 0, 1};
    for (int c = 0; c < 4; ++c) {
        if (channel_[c] >= 0) texel[c] = to_unit(value(x, y, channel_[c]), clamped);
    }
    clamped_ += clamped ? 1 : 0;
    return texel;
}

float TextureRows::read_scalar(int x, int y) {
    const WideTexel texel = read(x, y);
    // Exact where the channels are equal: the weights need not add up to 1 in floats.
    if (texel[0] == texel[1] && texel[1] == texel[2]) return texel[0];
    return luminance(Vec3f{texel[0], texel[1], texel[2]});
}

void TextureRows::read_heights() {
    heights_.reserve(static_cast<std::size_t>(image_.width) * image_.height);
    for (int y = 0; y < image_.height; ++y) {
        for (int x = 0; x < image_.width; ++x) heights_.push_back(read_scalar(x, y));
    }
}

// The image repeats.
float TextureRows::height(int x, int y) const {
    const int column = (x + image_.width) % image_.width;
    const int row = (y + image_.height) % image_.height;
    return heights_[static_cast<std::size_t>(row) * image_.width + column];
}

// The normal of the surface (u, v, height) by central differences. Heights and both axes are in
// units of the image's width, so that a relief keeps its slopes at any resolution; v runs up, rows
// down.
WideTexel TextureRows::normal_from_heights(int x, int y) const {
    const float slope = 0.5f * request_.relief * static_cast<float>(image_.width);
    const float along_u = slope * (height(x + 1, y) - height(x - 1, y));
    const float along_v = slope * (height(x, y - 1) - height(x, y + 1));
    const Vec3f normal = normalize(Vec3f{-along_u, -along_v, 1.0f});
    return {normal.x, normal.y, normal.z, 1};
}

void TextureRows::fill(int y, std::span<WideTexel> row) {
    const bool opacity_is_alpha = has_alpha_ && !request_.channel;
    for (int x = 0; x < image_.width; ++x) {
        WideTexel& texel = row[static_cast<std::size_t>(x)];
        if (request_.kind == TextureKind::kHeight) {
            texel = normal_from_heights(x, y);
        } else if (request_.kind == TextureKind::kOpacity) {
            texel.fill(opacity_is_alpha ? read(x, y)[3] : read_scalar(x, y));
        } else {
            texel = read(x, y);
            if (request_.kind != TextureKind::kNormal) continue;
            texel = {2 * texel[0] - 1, 2 * texel[1] - 1, 2 * texel[2] - 1, 1};
        }
    }
}

}  // namespace penumbra
