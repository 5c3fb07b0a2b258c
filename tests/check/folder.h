#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/image/exr.h"

namespace penumbra::tests {

// A folder of its own, removed at the end.
class Folder {
  public:
    Folder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "penumbra-XXXXXX").string();
        REQUIRE(mkdtemp(pattern.data()) != nullptr);
        path_ = pattern;
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    [[nodiscard]] std::string operator/(const std::string& name) const {
        return (path_ / name).string();
    }
    std::string write(const std::string& name, const std::string& text = "{}") const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << text;
        return *this / name;
    }
    [[nodiscard]] std::string path() const { return path_.string(); }

  private:
    std::filesystem::path path_;
};

// A picture of one row per channel name.
struct PictureChannel {
    std::string name;
    std::vector<float> values;
};
inline std::string write_picture(const std::string& file,
                                 const std::vector<PictureChannel>& channels,
                                 image::ExrCompression compression = image::ExrCompression::kZip,
                                 const image::ExrMetadata& metadata = {}) {
    image::ExrImage picture;
    const int width = static_cast<int>(channels.front().values.size());
    picture.display = picture.data = {.x1 = width, .y1 = 1};
    picture.compression = compression;
    picture.metadata = metadata;
    for (const PictureChannel& channel : channels)
        picture.channels.push_back({.name = channel.name,
                                    .type = image::ExrType::kFloat,
                                    .floats = {channel.values.data(), width}});
    image::write_exr(file, picture, 1);
    return file;
}

}  // namespace penumbra::tests
