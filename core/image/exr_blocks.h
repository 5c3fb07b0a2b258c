#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/image/exr.h"

// EXR files in pieces: any part, any channels, some rows at a time, for images that do not fit into
// memory.

namespace penumbra::image {

struct ExrPartInfo {
    std::string name;  // "" in files of one part
    Window display;
    Window data;
    std::vector<ExrChannelInfo> channels;  // by name
    int lines_per_block = 1;               // rows that are decoded together; of tiles: their height
    bool is_deep = false;
};

// Where the rows of one channel go; the view begins at the first row that is read and at the left
// of the data window. Half and float channels fill `floats`, uint ones `ids`.
struct ExrRows {
    std::string channel;
    PlaneView<float> floats{};
    PlaneView<std::uint32_t> ids{};
};

// One file, opened. Objects of the same file may be used by different threads at once, one object
// by one thread at a time.
class ExrBlocks {
  public:
    // Reads the headers. Throws InputError where it is not an EXR file or they are damaged; an
    // incomplete file has headers: ask missing_chunks().
    explicit ExrBlocks(const std::filesystem::path& file);
    ~ExrBlocks();
    ExrBlocks(ExrBlocks&&) noexcept;
    ExrBlocks& operator=(ExrBlocks&&) = delete;

    [[nodiscard]] const std::vector<ExrPartInfo>& parts() const;
    [[nodiscard]] std::size_t missing_chunks() const;  // of all parts

    // Rows [first, end) of the data window, counted from its top. Scan lines or tiles (their
    // full-size level). Throws InputError where the pixels are damaged, the part is deep or the
    // channel subsampled. Only for complete files.
    void read(int part, int first, int end, std::span<const ExrRows> rows);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace penumbra::image
