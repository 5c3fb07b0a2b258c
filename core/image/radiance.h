#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "core/image/decode.h"
#include "core/image/file_reader.h"

// Radiance HDR ("Radiance file formats", G. Ward): RGBE, flat or run-length coded either way, rows
// top down. The header's EXPOSURE is not applied, as in other readers.

namespace penumbra::image {

[[nodiscard]] bool is_radiance(std::span<const std::uint8_t> content);

// A file whose rows can be read in any order, for images that do not fit into memory: what is kept
// is where each row begins.
class RadianceRows {
  public:
    // Goes through the whole file once. Throws InputError where it is damaged or cut off. `file`
    // must outlive the rows.
    explicit RadianceRows(const FileReader& file);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    // Rows [first, end), counted from the top: `take` gets each with red, green and blue of its
    // pixels in turn. Threads may read at once.
    using Take = std::function<void(int row, std::span<const float> rgb)>;
    void read(int first, int end, const Take& take) const;

  private:
    void find_rows();

    const FileReader& file_;
    int width_ = 0, height_ = 0;
    std::vector<std::uint64_t> begins_;  // of the rows, and the end of the last one
};

// Throws InputError.
[[nodiscard]] DecodedImage decode_radiance(std::span<const std::uint8_t> content,
                                           const std::filesystem::path& name);

}  // namespace penumbra::image
