#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace penumbra::image {

// A file opened for reading at any place, or its bytes in memory. Throws InputError where it is
// missing, not readable or not a regular file; OutputError where the disk fails.
class FileReader {
  public:
    explicit FileReader(const std::filesystem::path& file);
    // `content` must outlive the reader; `name` is for messages.
    FileReader(std::span<const std::uint8_t> content, std::filesystem::path name);
    ~FileReader();
    FileReader(const FileReader&) = delete;
    FileReader& operator=(const FileReader&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::uint64_t size() const { return size_; }
    // False, and nothing promised about `bytes`, where the file ends before them.
    [[nodiscard]] bool read_at(std::uint64_t offset, std::span<std::uint8_t> bytes) const;

  private:
    std::filesystem::path path_;
    std::uint64_t size_ = 0;
    std::span<const std::uint8_t> content_;
    int descriptor_ = -1;  // none: the bytes are `content_`
};

[[nodiscard]] std::vector<std::uint8_t> read_whole_file(const std::filesystem::path& file);

}  // namespace penumbra::image
