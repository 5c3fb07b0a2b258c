#include "core/image/file_checks.h"

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "core/image/decode.h"
#include "core/image/zlib_stream.h"

namespace penumbra::image {
namespace {

constexpr std::uint8_t kPngSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
// Deflate turns at most 258 bytes into 2 bits (RFC 1951).
constexpr std::uint64_t kLargestDeflateExpansion = 1032;
// A JPEG needs at least one bit for each block of 8 x 8 pixels.
constexpr std::uint64_t kJpegPixelsPerByte = 8 * 64;

std::uint32_t big_uint32(const std::uint8_t* bytes) {
    return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
           std::uint32_t{bytes[2]} << 8 | bytes[3];
}
std::uint32_t big_uint16(const std::uint8_t* bytes) {
    return std::uint32_t{bytes[0]} << 8 | bytes[1];
}

struct PngHeader {
    std::uint64_t width, height, bytes_per_row, bytes_per_pixel;
};

// IHDR's 13 bytes; combinations of depth and colour type as in the PNG specification, table 11.1.
PngHeader read_png_header(const std::uint8_t* data, const std::filesystem::path& name) {
    const unsigned depth = data[8];
    const unsigned type = data[9];
    const bool any_depth = depth == 1 || depth == 2 || depth == 4 || depth == 8 || depth == 16;
    const bool valid = (type == 0 && any_depth) || (type == 3 && any_depth && depth <= 8) ||
                       ((type == 2 || type == 4 || type == 6) && (depth == 8 || depth == 16));
    if (!valid || data[10] != 0 || data[11] != 0 || data[12] > 1) {
        throw InputError(name, "IHDR",
                         fmt::format("PNG colour type {} with {} bits, compression {}, filter {}, "
                                     "interlace {} does not exist",
                                     type, depth, data[10], data[11], data[12]));
    }
    constexpr unsigned kSamples[] = {1, 0, 3, 1, 2, 0, 4};
    const std::uint64_t width = big_uint32(data);
    const std::uint64_t bits = width * kSamples[type] * depth;
    // A palette becomes up to RGBA.
    const std::uint64_t decoded = type == 3 ? 4 : kSamples[type] * std::max(8u, depth) / 8;
    return {width, big_uint32(data + 4), (bits + 7) / 8, decoded};
}

// One chunk: a length, a type, data, a checksum over type and data.
struct PngChunk {
    std::string_view type;
    std::span<const std::uint8_t> data;
};

PngChunk next_png_chunk(std::span<const std::uint8_t>& rest, const std::filesystem::path& name) {
    if (rest.size() < 12) throw InputError(name, "the PNG file is cut off: it has no IEND");
    const std::uint32_t length = big_uint32(rest.data());
    const std::string_view type(reinterpret_cast<const char*>(rest.data()) + 4, 4);
    const bool is_text = std::all_of(type.begin(), type.end(), [](unsigned char c) {
        return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    });
    if (!is_text) throw InputError(name, "the PNG file is damaged: expected a chunk's name");
    if (length > rest.size() - 12) {
        throw InputError(name, type,
                         fmt::format("the PNG file is cut off: the chunk has {} bytes, the file {}",
                                     length, rest.size() - 12));
    }
    if (crc32(rest.subspan(4, length + 4)) != big_uint32(rest.data() + 8 + length)) {
        throw InputError(name, type, "the PNG file is damaged: the chunk's checksum is wrong");
    }
    const PngChunk chunk{type, rest.subspan(8, length)};
    rest = rest.subspan(12 + length);
    return chunk;
}

constexpr std::uint8_t kJpegHuffman = 0xC4;
constexpr std::uint8_t kJpegEnd = 0xD9;
constexpr std::uint8_t kJpegScan = 0xDA;

// What follows the marker at `at` and its two bytes of length.
std::span<const std::uint8_t> jpeg_segment(std::span<const std::uint8_t> content, std::size_t at,
                                           const std::filesystem::path& name) {
    const std::size_t length = at + 4 > content.size() ? 0 : big_uint16(&content[at + 2]);
    if (length < 2 || at + 2 + length > content.size()) {
        throw InputError(
            name, fmt::format("the JPEG file is cut off in segment {:#04x}", content[at + 1]));
    }
    return content.subspan(at + 4, length - 2);
}

// stb writes as many code lengths as a table claims, beyond its array of 257.
void check_jpeg_huffman(std::span<const std::uint8_t> data, const std::filesystem::path& name) {
    while (!data.empty()) {
        std::size_t codes = 0;
        for (std::size_t i = 1; i < std::min<std::size_t>(17, data.size()); ++i) codes += data[i];
        if (codes > 256 || data.size() < 17 + codes) {
            throw InputError(name, "the JPEG file is damaged: a Huffman table of the wrong size");
        }
        data = data.subspan(17 + codes);
    }
}

// Coded pixels run to the next marker that is neither a stuffed zero nor a restart.
std::size_t end_of_jpeg_scan(std::span<const std::uint8_t> content, std::size_t at) {
    for (; at + 1 < content.size(); ++at) {
        const std::uint8_t next = content[at + 1];
        if (content[at] == 0xFF && next != 0 && (next < 0xD0 || next > 0xD7)) return at;
    }
    return content.size();
}

bool is_frame_header(std::uint8_t marker) {
    return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

void check_jpeg_frame(std::uint8_t marker, std::span<const std::uint8_t> data,
                      std::size_t file_size, const std::filesystem::path& name) {
    if (marker > 0xC2) {
        throw InputError(name,
                         fmt::format("JPEG coding SOF{} (lossless, hierarchical or arithmetic), "
                                     "expected baseline or progressive",
                                     marker - 0xC0));
    }
    if (data.size() < 6 || data.size() != 6 + std::size_t{3} * data[5]) {
        throw InputError(name, "the JPEG frame header is damaged");
    }
    if (data[0] != 8) throw InputError(name, fmt::format("a JPEG of {} bits, expected 8", data[0]));
    const std::uint64_t height = big_uint16(&data[1]);
    const std::uint64_t width = big_uint16(&data[3]);
    check_image_size(width, height, data[5], name);
    if (width * height / kJpegPixelsPerByte > file_size) {
        throw InputError(name, fmt::format("{} x {} pixels do not fit into a JPEG of {} bytes",
                                           width, height, file_size));
    }
}

}  // namespace

bool is_png(std::span<const std::uint8_t> content) {
    return content.size() >= sizeof(kPngSignature) &&
           std::memcmp(content.data(), kPngSignature, sizeof(kPngSignature)) == 0;
}

bool is_jpeg(std::span<const std::uint8_t> content) {
    return content.size() >= 3 && content[0] == 0xFF && content[1] == 0xD8 && content[2] == 0xFF;
}

void check_image_size(std::uint64_t width, std::uint64_t height, std::uint64_t bytes_per_pixel,
                      const std::filesystem::path& name) {
    if (width == 0 || height == 0) {
        throw InputError(name, fmt::format("the image is empty: {} x {} pixels", width, height));
    }
    if (width > kMaxImageSide || height > kMaxImageSide ||
        width * height * bytes_per_pixel > kMaxDecodedBytes) {
        throw InputError(name,
                         fmt::format("the image has {} x {} pixels, at most {} on a side and {} "
                                     "MiB of samples are supported",
                                     width, height, kMaxImageSide, kMaxDecodedBytes >> 20));
    }
}

void check_png(std::span<const std::uint8_t> content, const std::filesystem::path& name) {
    std::span<const std::uint8_t> rest = content.subspan(sizeof(kPngSignature));
    const PngChunk first = next_png_chunk(rest, name);
    if (first.type != "IHDR" || first.data.size() != 13) {
        throw InputError(name,
                         "the PNG file is damaged: it does not begin with an IHDR of 13 bytes");
    }
    const PngHeader header = read_png_header(first.data.data(), name);
    check_image_size(header.width, header.height, header.bytes_per_pixel, name);
    std::uint64_t packed = 0;
    for (PngChunk chunk = first; chunk.type != "IEND";) {
        chunk = next_png_chunk(rest, name);
        if (chunk.type == "IDAT") packed += chunk.data.size();
        if (chunk.type == "IHDR") throw InputError(name, "the PNG file has a second IHDR");
    }
    if (header.bytes_per_row * header.height / kLargestDeflateExpansion > packed) {
        throw InputError(name, fmt::format("{} x {} pixels do not fit into {} bytes of PNG data",
                                           header.width, header.height, packed));
    }
}

void check_jpeg(std::span<const std::uint8_t> content, const std::filesystem::path& name) {
    std::size_t at = 2;
    bool has_frame = false;
    while (true) {
        while (at + 1 < content.size() && content[at] == 0xFF && content[at + 1] == 0xFF) ++at;
        if (at + 2 > content.size()) {
            throw InputError(name, "the JPEG file is cut off: it has no end marker");
        }
        if (content[at] != 0xFF) {
            throw InputError(name, "the JPEG file is damaged: expected a marker");
        }
        const std::uint8_t marker = content[at + 1];
        if (marker == kJpegEnd) break;
        const std::span<const std::uint8_t> data = jpeg_segment(content, at, name);
        if (is_frame_header(marker)) {
            check_jpeg_frame(marker, data, content.size(), name);
            has_frame = true;
        }
        if (marker == kJpegHuffman) check_jpeg_huffman(data, name);
        at += 4 + data.size();
        if (marker == kJpegScan) at = end_of_jpeg_scan(content, at);
    }
    if (!has_frame) throw InputError(name, "the JPEG file has no frame header");
}

}  // namespace penumbra::image
