#include "core/image/exr_structure.h"

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "core/image/decode.h"

namespace penumbra::image {
namespace {

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kTiledFlag = 0x200;
constexpr std::uint32_t kLongNamesFlag = 0x400;
constexpr std::uint32_t kDeepFlag = 0x800;
constexpr std::uint32_t kMultiPartFlag = 0x1000;
constexpr std::size_t kMaxNameLength = 255;
constexpr std::size_t kMaxAttributes = 4096;
constexpr std::size_t kMaxAttributeBytes = std::size_t{64} << 20;
constexpr std::size_t kMaxParts = 1024;
constexpr int kMaxCoordinate = 1 << 24;  // of a window, either sign

// Reads a header front to back; throws where the file ends too early.
class Cursor {
  public:
    explicit Cursor(const FileReader& file) : file_(file) {}

    [[nodiscard]] std::uint64_t position() const { return position_; }
    [[noreturn]] void fail(std::string_view message) const {
        throw InputError(file_.path(), fmt::format("byte {}", position_), message);
    }
    void bytes(std::span<std::uint8_t> to) {
        if (!file_.read_at(position_, to)) fail("the EXR header ends here, cut off");
        position_ += to.size();
    }
    std::uint32_t uint32() {
        std::uint8_t raw[4];
        bytes(raw);
        return little_uint32(raw);
    }
    // Up to the zero byte.
    std::string text() {
        char window[kMaxNameLength + 1];
        const std::size_t readable =
            std::min<std::uint64_t>(sizeof(window), file_.size() - position_);
        const std::span<std::uint8_t> raw(reinterpret_cast<std::uint8_t*>(window), readable);
        if (!file_.read_at(position_, raw)) fail("the EXR header ends here, cut off");
        const char* end = static_cast<const char*>(std::memchr(window, 0, readable));
        if (end == nullptr) fail("expected a name of at most 255 characters");
        position_ += static_cast<std::uint64_t>(end - window) + 1;
        return std::string(static_cast<const char*>(window), end);
    }

  private:
    const FileReader& file_;
    std::uint64_t position_ = 0;
};

// An attribute without a value is none: the empty name ends a header.
bool read_attribute(Cursor& cursor, const FileReader& file, ExrAttribute& attribute) {
    attribute.name = cursor.text();
    if (attribute.name.empty()) return false;
    attribute.type_offset = cursor.position();
    attribute.type = cursor.text();
    if (attribute.type.empty()) cursor.fail("an EXR attribute without a type");
    const std::uint32_t size = cursor.uint32();
    if (size > kMaxAttributeBytes || size > file.size() - cursor.position()) {
        cursor.fail(fmt::format("EXR attribute '{}' claims {} bytes, more than the file has",
                                attribute.name, size));
    }
    attribute.value.resize(size);
    cursor.bytes(attribute.value);
    return true;
}

// The value of an attribute that lays out pixels, with the type and size that it must have.
const std::uint8_t* require(const ExrPart& part, const Cursor& cursor, std::string_view name,
                            std::string_view type, std::size_t size) {
    const ExrAttribute* attribute = part.find(name);
    if (attribute == nullptr) cursor.fail(fmt::format("the EXR header has no '{}'", name));
    if (attribute->type != type || attribute->value.size() != size) {
        cursor.fail(fmt::format("EXR attribute '{}' is a {} of {} bytes, expected {} of {}", name,
                                attribute->type, attribute->value.size(), type, size));
    }
    return attribute->value.data();
}

Window read_window(const ExrPart& part, const Cursor& cursor, std::string_view name) {
    const std::uint8_t* box = require(part, cursor, name, "box2i", 16);
    std::int32_t corner[4];
    for (int i = 0; i < 4; ++i) {
        corner[i] = static_cast<std::int32_t>(little_uint32(box + 4 * i));
        if (corner[i] < -kMaxCoordinate || corner[i] > kMaxCoordinate) {
            cursor.fail(fmt::format("EXR {} reaches to {}, supported are +-2^24", name, corner[i]));
        }
    }
    const Window window{corner[0], corner[1], corner[2] + 1, corner[3] + 1};
    if (window.width() < 1 || window.height() < 1) {
        cursor.fail(fmt::format("EXR {} is empty: {} x {}", name, window.width(), window.height()));
    }
    return window;
}

void check_size(const Window& window, const Cursor& cursor, std::string_view name) {
    if (window.width() > kMaxImageSide || window.height() > kMaxImageSide) {
        cursor.fail(fmt::format("EXR {} is {} x {}, at most {} x {} are supported", name,
                                window.width(), window.height(), kMaxImageSide, kMaxImageSide));
    }
}

std::vector<ExrChannelInfo> read_channels(const ExrPart& part, const Cursor& cursor) {
    const ExrAttribute* attribute = part.find("channels");
    if (attribute == nullptr || attribute->type != "chlist") {
        cursor.fail("the EXR header has no channel list");
    }
    std::vector<ExrChannelInfo> channels;
    std::span<const std::uint8_t> rest = attribute->value;
    while (!rest.empty() && rest.front() != 0) {
        const auto end = std::find(rest.begin(), rest.end(), std::uint8_t{0});
        const auto length = static_cast<std::size_t>(end - rest.begin());
        if (length > kMaxNameLength || rest.size() < length + 17) {
            cursor.fail("the EXR channel list is cut off");
        }
        const std::uint8_t* fields = rest.data() + length + 1;
        ExrChannelInfo channel;
        channel.name.assign(rest.begin(), end);
        const std::uint32_t type = little_uint32(fields);
        channel.x_sampling = static_cast<int>(little_uint32(fields + 8));
        channel.y_sampling = static_cast<int>(little_uint32(fields + 12));
        if (type > 2 || channel.x_sampling < 1 || channel.y_sampling < 1) {
            cursor.fail(fmt::format("EXR channel '{}' has type {} and sampling {} x {}",
                                    channel.name, type, channel.x_sampling, channel.y_sampling));
        }
        channel.type = static_cast<ExrType>(type);
        channels.push_back(std::move(channel));
        rest = rest.subspan(length + 17);
        if (channels.size() > kMaxExrChannels) cursor.fail("an EXR file with over 1024 channels");
    }
    if (rest.size() != 1) cursor.fail("the EXR channel list does not end where it should");
    if (channels.empty()) cursor.fail("an EXR file without channels");
    return channels;
}

std::size_t divided_up(std::size_t n, std::size_t by) {
    return (n + by - 1) / by;
}

// Sizes of a mip chain along one axis, as EXR rounds them.
std::vector<std::size_t> level_sizes(std::size_t size, bool round_up) {
    std::vector<std::size_t> sizes{size};
    while (size > 1) {
        size = round_up ? divided_up(size, 2) : size / 2;
        sizes.push_back(size);
    }
    return sizes;
}

std::size_t count_tiles(const ExrPart& part, const Cursor& cursor) {
    const std::uint8_t* tiles = require(part, cursor, "tiles", "tiledesc", 9);
    const std::size_t width = little_uint32(tiles);
    const std::size_t height = little_uint32(tiles + 4);
    const int mode = tiles[8] & 15;
    if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide || mode > 2 ||
        tiles[8] >> 4 > 1) {
        cursor.fail(fmt::format("EXR tiles of {} x {} in mode {}", width, height, tiles[8]));
    }
    const bool round_up = tiles[8] >> 4 == 1;
    const auto pixels_x = static_cast<std::size_t>(part.data.width());
    const auto pixels_y = static_cast<std::size_t>(part.data.height());
    if (mode == 0) return divided_up(pixels_x, width) * divided_up(pixels_y, height);
    if (mode == 1) {
        std::size_t x = pixels_x, y = pixels_y, count = 0;
        for (std::size_t n = level_sizes(std::max(x, y), round_up).size(); n > 0; --n) {
            count += divided_up(x, width) * divided_up(y, height);
            x = std::max<std::size_t>(1, round_up ? divided_up(x, 2) : x / 2);
            y = std::max<std::size_t>(1, round_up ? divided_up(y, 2) : y / 2);
        }
        return count;
    }
    std::size_t across = 0, down = 0;
    for (const std::size_t x : level_sizes(pixels_x, round_up)) across += divided_up(x, width);
    for (const std::size_t y : level_sizes(pixels_y, round_up)) down += divided_up(y, height);
    return across * down;
}

void read_layout(ExrPart& part, const Cursor& cursor, std::uint32_t flags) {
    part.is_tiled = (flags & kTiledFlag) != 0;
    part.is_deep = (flags & kDeepFlag) != 0;
    if ((flags & (kDeepFlag | kMultiPartFlag)) != 0) {
        const ExrAttribute* type = part.find("type");
        if (type == nullptr) cursor.fail("a part of the EXR file has no 'type'");
        const std::string value(type->value.begin(), type->value.end());
        part.is_tiled = value == "tiledimage" || value == "deeptile";
        part.is_deep = value == "deepscanline" || value == "deeptile";
        if (!part.is_tiled && !part.is_deep && value != "scanlineimage") {
            cursor.fail(fmt::format("a part of the EXR file has the unknown type '{}'", value));
        }
    }
    const std::uint8_t codec = *require(part, cursor, "compression", "compression", 1);
    if (codec > static_cast<std::uint8_t>(ExrCodec::kDwab)) {
        cursor.fail(fmt::format("EXR compression number {} is unknown", codec));
    }
    part.codec = static_cast<ExrCodec>(codec);
    if (*require(part, cursor, "lineOrder", "lineOrder", 1) > 2) {
        cursor.fail("the EXR line order is unknown");
    }
    require(part, cursor, "pixelAspectRatio", "float", 4);
    require(part, cursor, "screenWindowCenter", "v2f", 8);
    require(part, cursor, "screenWindowWidth", "float", 4);
    part.display = read_window(part, cursor, "displayWindow");
    part.data = read_window(part, cursor, "dataWindow");
    check_size(part.display, cursor, "displayWindow");
    check_size(part.data, cursor, "dataWindow");
    part.channels = read_channels(part, cursor);
    part.chunks = part.is_tiled ? count_tiles(part, cursor)
                                : divided_up(static_cast<std::size_t>(part.data.height()),
                                             static_cast<std::size_t>(lines_per_chunk(part.codec)));
    if (part.find("chunkCount") != nullptr &&
        little_uint32(require(part, cursor, "chunkCount", "int", 4)) != part.chunks) {
        cursor.fail(
            fmt::format("the EXR chunkCount is not {}, as its windows require", part.chunks));
    }
}

ExrPart read_part(Cursor& cursor, const FileReader& file, std::uint32_t flags) {
    ExrPart part;
    for (ExrAttribute attribute; read_attribute(cursor, file, attribute);) {
        if (part.find(attribute.name) != nullptr) {
            cursor.fail(fmt::format("EXR attribute '{}' occurs twice", attribute.name));
        }
        part.attributes.push_back(std::move(attribute));
        if (part.attributes.size() > kMaxAttributes) cursor.fail("over 4096 EXR attributes");
    }
    if (part.attributes.empty()) return part;
    read_layout(part, cursor, flags);
    return part;
}

}  // namespace

std::uint32_t little_uint32(const std::uint8_t* bytes) {
    std::uint32_t value;
    std::memcpy(&value, bytes, sizeof(value));
    return value;
}

std::uint64_t little_uint64(const std::uint8_t* bytes) {
    std::uint64_t value;
    std::memcpy(&value, bytes, sizeof(value));
    return value;
}

const ExrAttribute* ExrPart::find(std::string_view wanted) const {
    const auto at = std::find_if(attributes.begin(), attributes.end(),
                                 [&](const ExrAttribute& a) { return a.name == wanted; });
    return at == attributes.end() ? nullptr : &*at;
}

std::size_t ExrPart::bytes_per_pixel() const {
    std::size_t bytes = 0;
    for (const ExrChannelInfo& channel : channels) bytes += channel.type == ExrType::kHalf ? 2 : 4;
    return bytes;
}

int lines_per_chunk(ExrCodec codec) {
    constexpr int kLines[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    return kLines[static_cast<int>(codec)];
}

std::string_view name(ExrCodec codec) {
    constexpr std::string_view kNames[] = {"none",  "rle", "zips", "zip",  "piz",
                                           "pxr24", "b44", "b44a", "dwaa", "dwab"};
    return kNames[static_cast<int>(codec)];
}

ExrStructure read_exr_structure(const FileReader& file) {
    Cursor cursor(file);
    if (cursor.uint32() != kMagic) throw InputError(file.path(), "is not an EXR file");
    const std::uint32_t version = cursor.uint32();
    const std::uint32_t flags = version & ~0xFFu;
    if ((version & 0xFF) != 2 ||
        (flags & ~(kTiledFlag | kLongNamesFlag | kDeepFlag | kMultiPartFlag)) != 0) {
        cursor.fail(fmt::format("EXR version {} with flags {:#x}, expected version 2",
                                version & 0xFF, flags));
    }
    ExrStructure structure;
    const bool multi_part = (flags & kMultiPartFlag) != 0;
    do {
        ExrPart part = read_part(cursor, file, flags);
        if (part.attributes.empty()) break;
        structure.parts.push_back(std::move(part));
        if (structure.parts.size() > kMaxParts) cursor.fail("over 1024 EXR parts");
    } while (multi_part);
    if (structure.parts.empty()) cursor.fail("the EXR header is empty");
    structure.missing_chunks =
        count_missing_chunks(file, structure.parts, cursor.position(), multi_part);
    return structure;
}

}  // namespace penumbra::image
