#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/image/plane.h"

// OpenEXR files out and in. The only header through which anybody meets EXR.

namespace penumbra::image {

enum class ExrCompression { kNone, kRle, kZips, kZip, kPiz, kDwaa };
enum class ExrType { kUint, kHalf, kFloat };

// All of them, and their names as on the command line: none, rle, zips, zip, piz, dwaa.
[[nodiscard]] std::span<const ExrCompression> exr_compressions();
[[nodiscard]] std::string_view name(ExrCompression compression);
[[nodiscard]] std::string_view name(ExrType type);

// Pixels [x0, x1) x [y0, y1), y down. EXR stores the last pixel instead of the end; this does not.
struct Window {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    [[nodiscard]] int width() const { return x1 - x0; }
    [[nodiscard]] int height() const { return y1 - y0; }
    friend bool operator==(const Window&, const Window&) = default;
};

// 16 numbers in memory order. Column-major for column vectors (glm::value_ptr) and row-major for
// row vectors (what OpenEXR's worldToCamera and worldToNDC mean) are the same order: copy, never
// transpose.
struct ExrMatrix {
    std::array<float, 16> values{};
    friend bool operator==(const ExrMatrix&, const ExrMatrix&) = default;
};
struct ExrRational {  // framesPerSecond
    int numerator = 0;
    unsigned denominator = 1;
    friend bool operator==(const ExrRational&, const ExrRational&) = default;
};
using ExrValue = std::variant<std::string, int, float, ExrMatrix, ExrRational>;
// By attribute name, sorted. Nothing volatile (time, host, path) belongs here.
using ExrMetadata = std::map<std::string, ExrValue>;

// ---- out -------------------------------------------------------------------------------------

// One channel to be written. kHalf and kFloat read `floats`, kUint reads `ids`; (0, 0) of the view
// is the data window's top left.
struct ExrChannel {
    std::string name;  // "R", "albedo.R", "id.instance": at most 31 characters
    ExrType type = ExrType::kHalf;
    PlaneView<const float> floats{};
    PlaneView<const std::uint32_t> ids{};
};

struct ExrImage {
    Window display;  // the full frame
    Window data;     // what is stored: the crop
    std::vector<ExrChannel> channels;
    ExrMetadata metadata;
    ExrCompression compression = ExrCompression::kZip;
};

struct ExrWriteReport {
    std::size_t clamped_values = 0;  // finite, but beyond +-65504 in a half channel: stored as that
    std::size_t non_finite_values = 0;  // NaN and infinities, of all channels, stored as they are
};

// Writes one single-part scan-line file, the same bytes whatever `threads` (at least 1, encoding in
// parallel). Throws OutputError where the disk refuses; what is left then is not a file to keep:
// see core/image/publish.h.
ExrWriteReport write_exr(const std::filesystem::path& file, const ExrImage& image, int threads);

// ---- in --------------------------------------------------------------------------------------

struct ExrChannelInfo {
    std::string name;
    ExrType type = ExrType::kHalf;
    int x_sampling = 1;
    int y_sampling = 1;
};

// What a file says about itself, read without decoding a pixel. Of a multi-part file: its first
// part.
struct ExrHeader {
    Window display;
    Window data;
    std::vector<ExrChannelInfo> channels;  // in the file's order: by name
    std::string compression;  // as on the command line, or zips, pxr24, b44, b44a, dwab
    ExrMetadata metadata;     // attributes of the types above that are not part of the layout
    int parts = 1;
    bool is_tiled = false;
    bool is_deep = false;
    std::size_t chunks = 0;          // blocks of scan lines, or tiles
    std::size_t missing_chunks = 0;  // not in the file, or cut off
    [[nodiscard]] bool is_complete() const { return missing_chunks == 0; }
};

// Throws InputError where it is not an EXR file or its header is damaged. An incomplete file has a
// header: ask is_complete().
[[nodiscard]] ExrHeader read_exr_header(const std::filesystem::path& file);

// One channel that was read; half and float fill `floats`, uint fills `ids`. Size of the data
// window.
struct ExrPlane {
    std::string name;
    ExrType type = ExrType::kHalf;
    Plane<float> floats;
    Plane<std::uint32_t> ids;
};

struct ExrPixels {
    ExrHeader header;
    std::vector<ExrPlane> planes;  // in the order of header.channels
    // nullptr where there is no such channel.
    [[nodiscard]] const ExrPlane* find(std::string_view channel) const;
};

// Scan-line or tiled (its full-size level); deep, incomplete and subsampled files throw InputError.
[[nodiscard]] ExrPixels read_exr(const std::filesystem::path& file);

}  // namespace penumbra::image
