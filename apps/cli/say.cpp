#include "apps/cli/say.h"

#include "core/error.h"

namespace penumbra::cli {

std::string one_line(std::string_view text) {
    std::string line;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '\n')
            line += "\\n";
        else if (c == '\t')
            line += "\\t";
        else if (byte < 32 || byte == 127)
            line += fmt::format("\\x{:02x}", byte);
        else
            line += c;
    }
    return line;
}

void say_error(std::string_view message) {
    say(stderr, "error: {}\n", one_line(message));
}

void require_said() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        throw OutputError("standard output cannot be written");
}

}  // namespace penumbra::cli
