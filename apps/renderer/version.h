#pragma once

#include <string_view>

namespace penumbra::renderer {

// "0.1.0"; part of every frame's settings digest.
[[nodiscard]] std::string_view version();

}  // namespace penumbra::renderer
