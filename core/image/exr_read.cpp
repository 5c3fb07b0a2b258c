#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "core/image/exr.h"
#include "core/image/exr_structure.h"

namespace penumbra::image {
namespace {

// Pixels of one file, decoded: two 4K frames of 40 channels fit.
constexpr std::size_t kMaxPixelBytes = std::size_t{1} << 32;

// Attributes that lay out pixels: OpenEXR must see these. It need not parse any other.
constexpr std::string_view kLayoutAttributes[] = {
    "channels",
    "compression",
    "dataWindow",
    "displayWindow",
    "lineOrder",
    "pixelAspectRatio",
    "screenWindowCenter",
    "screenWindowWidth",
    "tiles",
    "type",
    "name",
    "version",
    "chunkCount",
};

bool is_layout(std::string_view name) {
    return std::find(std::begin(kLayoutAttributes), std::end(kLayoutAttributes), name) !=
           std::end(kLayoutAttributes);
}

float little_float(const std::uint8_t* bytes) {
    float value;
    std::memcpy(&value, bytes, sizeof(value));
    return value;
}

ExrMatrix read_matrix(const std::uint8_t* bytes) {
    ExrMatrix matrix;
    std::memcpy(matrix.values.data(), bytes, sizeof(matrix.values));
    return matrix;
}

ExrMetadata read_metadata(const ExrPart& part) {
    ExrMetadata metadata;
    for (const ExrAttribute& attribute : part.attributes) {
        const std::uint8_t* value = attribute.value.data();
        const auto is = [&](std::string_view type, std::size_t size) {
            return attribute.type == type && attribute.value.size() == size;
        };
        if (is_layout(attribute.name)) continue;
        if (attribute.type == "string") {
            metadata[attribute.name] = std::string(attribute.value.begin(), attribute.value.end());
        } else if (is("int", 4)) {
            metadata[attribute.name] = static_cast<int>(little_uint32(value));
        } else if (is("float", 4)) {
            metadata[attribute.name] = little_float(value);
        } else if (is("m44f", 64)) {
            metadata[attribute.name] = read_matrix(value);
        } else if (is("rational", 8)) {
            metadata[attribute.name] =
                ExrRational{static_cast<int>(little_uint32(value)), little_uint32(value + 4)};
        }
    }
    return metadata;
}

ExrHeader to_header(const ExrStructure& structure) {
    const ExrPart& part = structure.parts.front();
    ExrHeader header;
    header.display = part.display;
    header.data = part.data;
    header.channels = part.channels;
    header.compression = name(part.codec);
    header.metadata = read_metadata(part);
    header.parts = static_cast<int>(structure.parts.size());
    header.is_tiled = part.is_tiled;
    header.is_deep = part.is_deep;
    for (const ExrPart& each : structure.parts) header.chunks += each.chunks;
    header.missing_chunks = structure.missing_chunks;
    return header;
}

// How many times larger than its file an image may be, where the codec has a limit: deflate packs
// at most 1032 to 1, run lengths 128 bytes into 2.
std::size_t largest_expansion(ExrCodec codec) {
    switch (codec) {
        case ExrCodec::kNone:
            return 1;
        case ExrCodec::kRle:
            return 64;
        case ExrCodec::kZips:
        case ExrCodec::kZip:
            return 1032;
        case ExrCodec::kPxr24:
            return 2 * 1032;
        default:
            return kMaxPixelBytes;
    }
}

void check_readable(const FileReader& file, const ExrStructure& structure, std::size_t channels) {
    const ExrPart& part = structure.parts.front();
    const auto refuse = [&](const std::string& message) { throw InputError(file.path(), message); };
    if (structure.missing_chunks > 0) {
        refuse(fmt::format("the EXR file is incomplete: {} of its blocks of pixels are missing",
                           structure.missing_chunks));
    }
    if (part.is_deep) refuse("a deep EXR image, expected one with one value per pixel");
    for (const ExrChannelInfo& channel : part.channels) {
        if (channel.x_sampling == 1 && channel.y_sampling == 1) continue;
        refuse(fmt::format("EXR channel '{}' is subsampled {} x {}, expected full resolution",
                           channel.name, channel.x_sampling, channel.y_sampling));
    }
    const std::size_t pixels = static_cast<std::size_t>(part.data.width()) * part.data.height();
    if (pixels * channels * 4 > kMaxPixelBytes) {
        refuse(fmt::format("{} x {} pixels of {} channels need over 4 GiB", part.data.width(),
                           part.data.height(), channels));
    }
    if (pixels * part.bytes_per_pixel() / largest_expansion(part.codec) > file.size()) {
        refuse(fmt::format("{} x {} pixels do not fit into an EXR file of {} bytes",
                           part.data.width(), part.data.height(), file.size()));
    }
}

// The file's bytes for OpenEXR.
class MemoryStream : public Imf::IStream {
  public:
    MemoryStream(const char* name, std::vector<std::uint8_t> content)
        : IStream(name), content_(std::move(content)) {}
    bool read(char to[], int count) override {
        if (count < 0 || position_ > content_.size() ||
            static_cast<std::uint64_t>(count) > content_.size() - position_) {
            throw Iex::InputExc("the file ends too early");
        }
        std::memcpy(to, content_.data() + position_, static_cast<std::size_t>(count));
        position_ += static_cast<std::uint64_t>(count);
        return position_ < content_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

  private:
    std::vector<std::uint8_t> content_;
    std::uint64_t position_ = 0;
};

// Attributes that do not lay out pixels get a type that OpenEXR does not know and takes as bytes:
// so no preview, string list or manifest of a damaged file is ever interpreted.
std::vector<std::uint8_t> content_with_plain_header(const FileReader& file,
                                                    const ExrStructure& structure) {
    std::vector<std::uint8_t> content(file.size());
    if (!file.read_at(0, content))
        throw InputError(file.path(), "became shorter while it was read");
    for (const ExrPart& part : structure.parts) {
        for (const ExrAttribute& attribute : part.attributes) {
            if (!is_layout(attribute.name)) content[attribute.type_offset] = '?';
        }
    }
    return content;
}

template <class T>
void insert(Imf::FrameBuffer& buffer, const ExrHeader& header, const std::string& name,
            Imf::PixelType type, Plane<T>& plane) {
    plane = Plane<T>(header.data.width(), header.data.height());
    buffer.insert(name, Imf::Slice::Make(type, plane.row(0), {header.data.x0, header.data.y0},
                                         header.data.width(), header.data.height(), sizeof(T),
                                         static_cast<std::size_t>(plane.stride()) * sizeof(T)));
}

Imf::FrameBuffer make_frame_buffer(ExrPixels& pixels) {
    Imf::FrameBuffer buffer;
    for (ExrPlane& plane : pixels.planes) {
        if (plane.type == ExrType::kUint) {
            insert(buffer, pixels.header, plane.name, Imf::UINT, plane.ids);
        } else {
            insert(buffer, pixels.header, plane.name, Imf::FLOAT, plane.floats);
        }
    }
    return buffer;
}

}  // namespace

ExrHeader read_exr_header(const std::filesystem::path& file) {
    return to_header(read_exr_structure(FileReader(file)));
}

const ExrPlane* ExrPixels::find(std::string_view channel) const {
    const auto at = std::find_if(planes.begin(), planes.end(),
                                 [&](const ExrPlane& plane) { return plane.name == channel; });
    return at == planes.end() ? nullptr : &*at;
}

ExrPixels read_exr(const std::filesystem::path& path) {
    const FileReader file(path);
    return read_exr_pixels(file, read_exr_structure(file), {});
}

ExrPixels read_exr_pixels(const FileReader& file, const ExrStructure& structure,
                          std::span<const std::string> channels) {
    ExrPixels pixels;
    pixels.header = to_header(structure);
    for (const ExrChannelInfo& channel : pixels.header.channels) {
        if (channels.empty() ||
            std::find(channels.begin(), channels.end(), channel.name) != channels.end()) {
            pixels.planes.push_back({channel.name, channel.type, {}, {}});
        }
    }
    check_readable(file, structure, pixels.planes.size());
    try {
        MemoryStream stream(file.path().c_str(), content_with_plain_header(file, structure));
        Imf::InputFile input(stream, 0);
        input.setFrameBuffer(make_frame_buffer(pixels));
        input.readPixels(pixels.header.data.y0, pixels.header.data.y1 - 1);
    } catch (const std::exception& error) {
        throw InputError(file.path(), fmt::format("the EXR file is damaged: {}", error.what()));
    }
    return pixels;
}

}  // namespace penumbra::image
