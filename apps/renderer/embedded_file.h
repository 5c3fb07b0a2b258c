#pragma once

#include <span>
#include <string_view>

namespace penumbra::renderer {

// A file that was compiled into the library.
struct EmbeddedFile {
    std::string_view name;  // without folders
    struct Bytes {
        const char* begin;
        const char* end;
    } bytes;

    [[nodiscard]] std::string_view content() const {
        return {bytes.begin, static_cast<std::size_t>(bytes.end - bytes.begin)};
    }
};

// The files of the built-in scene; the build writes this function (cmake/EmbedFiles.cmake).
[[nodiscard]] std::span<const EmbeddedFile> embedded_files();

}  // namespace penumbra::renderer
