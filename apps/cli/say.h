#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>

namespace penumbra::cli {

// Prints without throwing: a closed or full stream must not turn an error into a crash. Whoever
// needs to know asks require_said().
template <class... Args>
void say(std::FILE* stream, fmt::format_string<Args...> format, Args&&... args) {
    static_cast<void>(std::fputs(fmt::format(format, std::forward<Args>(args)...).c_str(), stream));
}

// The text with control characters as \n, \t, \x1b: names of files may hold any, but a message is
// one line.
[[nodiscard]] std::string one_line(std::string_view text);

// "error: <message>" on the error stream: one line, whatever the message holds.
void say_error(std::string_view message);

// Throws OutputError if standard output did not take all that was said.
void require_said();

}  // namespace penumbra::cli
