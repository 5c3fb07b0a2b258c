#pragma once

#include <fmt/format.h>

#include <cstdio>

namespace penumbra::cli {

// Prints without throwing: a closed or full stream must not turn an error into a crash. Whoever
// needs to know asks require_said().
template <class... Args>
void say(std::FILE* stream, fmt::format_string<Args...> format, Args&&... args) {
    static_cast<void>(std::fputs(fmt::format(format, std::forward<Args>(args)...).c_str(), stream));
}

// Throws OutputError if standard output did not take all that was said.
void require_said();

}  // namespace penumbra::cli
