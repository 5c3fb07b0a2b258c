#include "core/image/exr_decode.h"

#include <algorithm>

#include "core/error.h"
#include "core/image/exr_structure.h"
#include "core/image/file_checks.h"

namespace penumbra::image {
namespace {

bool has_channel(const ExrPart& part, const std::string& name) {
    return std::any_of(part.channels.begin(), part.channels.end(),
                       [&](const ExrChannelInfo& channel) { return channel.name == name; });
}

// The channels of one layer ("" or "name.") that make a picture; none where it has no colour.
std::vector<std::string> picture_channels(const ExrPart& part, const std::string& layer) {
    std::vector<std::string> names;
    if (has_channel(part, layer + "R") && has_channel(part, layer + "G") &&
        has_channel(part, layer + "B")) {
        names = {layer + "R", layer + "G", layer + "B"};
    } else if (has_channel(part, layer + "Y")) {
        names = {layer + "Y"};
    }
    if (!names.empty() && has_channel(part, layer + "A")) names.push_back(layer + "A");
    return names;
}

std::vector<std::string> choose_channels(const ExrPart& part, const std::filesystem::path& file) {
    std::vector<std::string> names = picture_channels(part, "");
    for (std::size_t i = 0; names.empty() && i < part.channels.size(); ++i) {
        const std::string& channel = part.channels[i].name;
        const std::size_t dot = channel.rfind('.');
        if (dot != std::string::npos) names = picture_channels(part, channel.substr(0, dot + 1));
    }
    if (names.empty() && part.channels.size() == 1) names = {part.channels.front().name};
    if (!names.empty()) return names;
    std::string found;
    for (std::size_t i = 0; i < std::min<std::size_t>(part.channels.size(), 8); ++i) {
        found += (i == 0 ? "" : ", ") + part.channels[i].name;
    }
    throw InputError(file, "channels",
                     fmt::format("expected R, G and B, or Y, or a single channel, got {}", found));
}

void place(const ExrPixels& pixels, const ExrPlane& plane, int channel, DecodedImage& image) {
    const Window& data = pixels.header.data;
    const Window& display = pixels.header.display;
    const int x0 = std::max(data.x0, display.x0), x1 = std::min(data.x1, display.x1);
    const int y0 = std::max(data.y0, display.y0), y1 = std::min(data.y1, display.y1);
    for (int y = y0; y < y1; ++y) {
        const std::size_t row = static_cast<std::size_t>(y - display.y0) * image.width;
        for (int x = x0; x < x1; ++x) {
            image.floats[(row + x - display.x0) * image.channels + channel] =
                plane.floats.at(x - data.x0, y - data.y0);
        }
    }
}

}  // namespace

bool is_exr(std::span<const std::uint8_t> content) {
    constexpr std::uint8_t kMagic[] = {0x76, 0x2F, 0x31, 0x01};
    return content.size() >= 4 && std::equal(std::begin(kMagic), std::end(kMagic), content.begin());
}

DecodedImage decode_exr(const FileReader& file) {
    const ExrStructure structure = read_exr_structure(file);
    const ExrPart& part = structure.parts.front();
    const std::vector<std::string> names = choose_channels(part, file.path());
    DecodedImage image;
    image.width = part.display.width();
    image.height = part.display.height();
    image.channels = static_cast<int>(names.size());
    image.type = SampleType::kFloat;
    for (const Window& window : {part.display, part.data}) {
        check_image_size(static_cast<std::uint64_t>(window.width()),
                         static_cast<std::uint64_t>(window.height()), 4 * names.size(),
                         file.path());
    }
    const ExrPixels pixels = read_exr_pixels(file, structure, names);
    image.floats.resize(image.sample_count());
    for (std::size_t channel = 0; channel < names.size(); ++channel) {
        const ExrPlane& plane = *pixels.find(names[channel]);
        if (plane.type == ExrType::kUint) {
            throw InputError(file.path(), plane.name,
                             "the channel holds ids, expected half or float");
        }
        place(pixels, plane, static_cast<int>(channel), image);
    }
    return image;
}

}  // namespace penumbra::image
