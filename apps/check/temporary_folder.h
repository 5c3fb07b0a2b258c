#pragma once

#include <filesystem>

namespace penumbra::check {

// A folder of our own in the system's place for such, with all in it gone at the end.
class TemporaryFolder {
  public:
    TemporaryFolder();  // throws OutputError
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace penumbra::check
