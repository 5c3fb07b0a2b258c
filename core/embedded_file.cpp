#include "core/embedded_file.h"

#include <algorithm>

#include "core/error.h"

namespace penumbra {

std::string_view content_of(std::span<const EmbeddedFile> files, std::string_view name) {
    const auto file = std::find_if(files.begin(), files.end(),
                                   [&](const EmbeddedFile& each) { return each.name == name; });
    PENUMBRA_ASSERT(file != files.end(), "name = {}", name);
    return file->content();
}

}  // namespace penumbra
