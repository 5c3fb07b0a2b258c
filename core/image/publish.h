#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

// Files appear under their name whole or not at all, whatever happens: an error, a full disk,
// SIGKILL, a power failure. What was there before stays until then.

namespace penumbra::image {

// A file in the making, called `<target>.part`.
//
//     PendingFile frame(target);
//     write_exr(frame.path(), image, threads);
//     require_complete(frame.path());
//     frame.publish();
//
// The name is fixed, so that a killed process leaves one file that the next run overwrites, and not
// a heap of them. While it lives it is locked (flock): a second process that writes the same target
// gets an OutputError instead of a mixture. Destroyed before publish(), it removes the partial
// file.
class PendingFile {
  public:
    // Creates missing folders and the empty partial file.
    explicit PendingFile(std::filesystem::path target);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return partial_; }
    // Appends; for files that are simply bytes.
    void write(std::span<const std::uint8_t> bytes);
    // Flushed to disk, renamed, the folder flushed. At most once.
    void publish();

  private:
    std::filesystem::path target_;
    std::filesystem::path partial_;
    int descriptor_ = -1;
};

// Throws OutputError unless the EXR file is whole: its header readable, every block of scan lines
// there.
void require_complete(const std::filesystem::path& exr_file);

// A PNG, a JSON file: all of its bytes at once.
void write_file_atomically(const std::filesystem::path& target,
                           std::span<const std::uint8_t> bytes);
void write_file_atomically(const std::filesystem::path& target, std::string_view text);

}  // namespace penumbra::image
