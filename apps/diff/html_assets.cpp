#include "apps/diff/html_assets.h"

#include <span>

#include "core/embedded_file.h"

namespace penumbra::diff {

// The files of apps/diff/page; the build writes this function (cmake/EmbedFiles.cmake).
[[nodiscard]] std::span<const EmbeddedFile> embedded_files();

std::string_view html_style() {
    return content_of(embedded_files(), "page.css");
}

std::string_view html_script() {
    return content_of(embedded_files(), "viewer.js");
}

}  // namespace penumbra::diff
