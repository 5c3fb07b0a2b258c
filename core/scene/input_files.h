#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Where the files of a scene come from: a folder, or memory (the built-in scene).

namespace penumbra {

// Contents by path relative to the scene, with '/' between folders.
using VirtualFiles = std::map<std::string, std::string, std::less<>>;

class InputFiles {
  public:
    InputFiles() = default;
    explicit InputFiles(const VirtualFiles* files) : virtual_(files) {}

    [[nodiscard]] bool is_virtual() const { return virtual_ != nullptr; }

    // The file that `name`, written in a file of `folder`, means: names of other systems are
    // understood (backslashes; a drive or an absolute path that does not exist here falls back to
    // the same path, then to the bare file name, in `folder`), as are wrong cases (.JPG). Nothing,
    // if there is none.
    [[nodiscard]] std::optional<std::filesystem::path> find(const std::filesystem::path& folder,
                                                            std::string_view name) const;

    // The whole content; the file is noted as read. Throws InputError where it is missing, no plain
    // file or longer than `limit`, OutputError where the disk fails.
    [[nodiscard]] std::string read(const std::filesystem::path& file,
                                   std::size_t limit = std::size_t{1} << 31);

    // Notes a file that somebody else reads.
    void note(const std::filesystem::path& file);

    // All that was read, each once, in the order of first reading.
    [[nodiscard]] const std::vector<std::filesystem::path>& read_files() const { return read_; }

  private:
    [[nodiscard]] bool exists(const std::filesystem::path& file) const;
    [[nodiscard]] std::optional<std::filesystem::path> find_any_case(
        const std::filesystem::path& folder, const std::filesystem::path& relative) const;

    const VirtualFiles* virtual_ = nullptr;
    std::vector<std::filesystem::path> read_;
};

// Throws InputError where the file is missing, a folder or a device.
void require_regular_file(const std::filesystem::path& file);

}  // namespace penumbra
