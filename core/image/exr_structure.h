#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/image/exr.h"
#include "core/image/file_reader.h"

// The skeleton of an EXR file, read by ourselves with every size checked against the file's, so
// that OpenEXR only ever meets headers that are sane and files that are whole. The layout is that
// of "OpenEXR File Layout" (openexr.com): magic, version, attributes, table of offsets, chunks.

namespace penumbra::image {

// Where an attribute's name, type and value lie in the file.
struct ExrAttribute {
    std::string name;
    std::string type;
    std::uint64_t type_offset = 0;
    std::vector<std::uint8_t> value;
};

enum class ExrCodec : std::uint8_t {
    kNone,
    kRle,
    kZips,
    kZip,
    kPiz,
    kPxr24,
    kB44,
    kB44a,
    kDwaa,
    kDwab
};

struct ExrPart {
    std::vector<ExrAttribute> attributes;
    Window display;
    Window data;
    std::vector<ExrChannelInfo> channels;
    ExrCodec codec = ExrCodec::kNone;
    bool is_tiled = false;
    bool is_deep = false;
    std::size_t chunks = 0;

    [[nodiscard]] const ExrAttribute* find(std::string_view name) const;
    [[nodiscard]] std::size_t bytes_per_pixel() const;
};

struct ExrStructure {
    std::vector<ExrPart> parts;
    std::size_t missing_chunks = 0;  // of all parts
};

inline constexpr std::size_t kMaxExrChannels = 1024;

// Throws InputError with the place of the damage.
[[nodiscard]] ExrStructure read_exr_structure(const FileReader& file);

// Chunks that are not in the file to their last byte, found through the tables of offsets that
// follow the headers at `position`.
[[nodiscard]] std::size_t count_missing_chunks(const FileReader& file,
                                               std::span<const ExrPart> parts,
                                               std::uint64_t position, bool multi_part);

[[nodiscard]] int lines_per_chunk(ExrCodec codec);
[[nodiscard]] std::string_view name(ExrCodec codec);

// Decodes the named channels, or all of them where none is named; see read_exr().
[[nodiscard]] ExrPixels read_exr_pixels(const FileReader& file, const ExrStructure& structure,
                                        std::span<const std::string> channels);

// Little-endian numbers out of an attribute's value; the value must be long enough.
[[nodiscard]] std::uint32_t little_uint32(const std::uint8_t* bytes);
[[nodiscard]] std::uint64_t little_uint64(const std::uint8_t* bytes);

}  // namespace penumbra::image
