#pragma once

#include <span>
#include <string_view>

namespace penumbra {

// A file that was compiled into a library. The build writes the list of a room's files, as the
// function `embedded_files()` of the room's namespace: see cmake/EmbedFiles.cmake.
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

// The content of the file with that name, which is one of them.
[[nodiscard]] std::string_view content_of(std::span<const EmbeddedFile> files,
                                          std::string_view name);

}  // namespace penumbra
