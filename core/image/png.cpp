#include "core/image/png.h"

#include <cstring>

#include "core/error.h"
#include "core/image/publish.h"
#include "core/image/zlib_stream.h"

namespace penumbra::image {
namespace {

void append_big(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) {
        bytes.push_back(static_cast<std::uint8_t>(value >> shift));
    }
}

void append_chunk(std::vector<std::uint8_t>& png, std::string_view type,
                  std::span<const std::uint8_t> data) {
    append_big(png, static_cast<std::uint32_t>(data.size()));
    const std::size_t begin = png.size();
    png.insert(png.end(), type.begin(), type.end());
    png.insert(png.end(), data.begin(), data.end());
    append_big(png, crc32(std::span(png).subspan(begin)));
}

// Every row minus the one above it (filter 2, "up"): good for smooth pictures, and the cheapest.
std::vector<std::uint8_t> filter_rows(const Picture& picture) {
    constexpr std::uint8_t kUp = 2;
    const std::size_t row = static_cast<std::size_t>(picture.width) * picture.channels;
    std::vector<std::uint8_t> filtered((row + 1) * static_cast<std::size_t>(picture.height));
    const std::vector<std::uint8_t> nothing(row, 0);
    const std::uint8_t* above = nothing.data();
    std::uint8_t* to = filtered.data();
    for (int y = 0; y < picture.height; ++y) {
        const std::uint8_t* from = picture.bytes.data() + static_cast<std::size_t>(y) * row;
        *to++ = kUp;
        for (std::size_t i = 0; i < row; ++i) to[i] = static_cast<std::uint8_t>(from[i] - above[i]);
        to += row;
        above = from;
    }
    return filtered;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Picture& picture) {
    PENUMBRA_ASSERT(picture.channels == 3 || picture.channels == 4, "{}", picture.channels);
    std::vector<std::uint8_t> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    std::vector<std::uint8_t> header;
    append_big(header, static_cast<std::uint32_t>(picture.width));
    append_big(header, static_cast<std::uint32_t>(picture.height));
    const std::uint8_t color_type = picture.channels == 4 ? 6 : 2;
    header.insert(header.end(), {8, color_type, 0, 0, 0});
    append_chunk(png, "IHDR", header);
    // The samples are sRGB; 0 is the perceptual rendering intent.
    append_chunk(png, "sRGB", std::vector<std::uint8_t>{0});
    append_chunk(png, "IDAT", deflate(filter_rows(picture)));
    append_chunk(png, "IEND", {});
    return png;
}

void write_png(const std::filesystem::path& file, const Picture& picture) {
    write_file_atomically(file, encode_png(picture));
}

}  // namespace penumbra::image
