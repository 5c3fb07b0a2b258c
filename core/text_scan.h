#pragma once

#include <optional>
#include <string>
#include <string_view>

// Small pieces for readers of text, and for messages about what they read.

namespace penumbra {

// Without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

// The first word of `text`, which is advanced behind it and the blanks that follow; empty at the
// end.
std::string_view take_word(std::string_view& text);

// A decimal number as OBJ and MTL write them: [+-] digits [. digits] [e [+-] digits]. Not nan, not
// inf.
[[nodiscard]] bool is_number(std::string_view word);

// Control characters replaced, cut to 60 bytes: fit for a message of one line.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace penumbra
