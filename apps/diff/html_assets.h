#pragma once

#include <string_view>

namespace penumbra::diff {

// The page's style sheet and script.
[[nodiscard]] std::string_view html_style();
[[nodiscard]] std::string_view html_script();

}  // namespace penumbra::diff
