#include "apps/diff/html_assets.h"

#include <algorithm>
#include <span>

#include "core/embedded_file.h"
#include "core/error.h"

namespace penumbra::diff {

// The files of apps/diff/page; the build writes this function (cmake/EmbedFiles.cmake).
[[nodiscard]] std::span<const EmbeddedFile> embedded_files();

namespace {

std::string_view page_file(std::string_view name) {
    const auto files = embedded_files();
    const auto file = std::find_if(files.begin(), files.end(),
                                   [&](const EmbeddedFile& each) { return each.name == name; });
    PENUMBRA_ASSERT(file != files.end(), "name = {}", name);
    return file->content();
}

}  // namespace

std::string_view html_style() {
    return page_file("page.css");
}

std::string_view html_script() {
    return page_file("viewer.js");
}

}  // namespace penumbra::diff
