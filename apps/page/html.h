#pragma once

#include <string>
#include <string_view>

#include "core/image/png.h"

// What pages of reports are made of, whoever reports: pages that need nothing but themselves.
// Pictures are embedded, and the page's own content security policy forbids every request.

namespace penumbra::page {

[[nodiscard]] std::string html_escaped(std::string_view text);
// What the src of an <img> may be.
[[nodiscard]] std::string html_data_uri(const image::Picture& picture);

// What a page holds besides words, tables and drawings: its policy allows no more.
enum class Content { kStill, kScriptsAndPictures };

// The page up to its heading, style sheet included.
[[nodiscard]] std::string html_begin(std::string_view title, Content content,
                                     std::string_view style);

}  // namespace penumbra::page
