#pragma once

#include <span>

#include "core/embedded_file.h"

namespace penumbra::renderer {

// The files of the built-in scene; the build writes this function (cmake/EmbedFiles.cmake).
[[nodiscard]] std::span<const EmbeddedFile> embedded_files();

}  // namespace penumbra::renderer
