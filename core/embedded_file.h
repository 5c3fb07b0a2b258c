#pragma once

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

}  // namespace penumbra
