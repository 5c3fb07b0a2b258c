#pragma once

#include <string>

#include "apps/cli/command_table.h"

// Scripts that complete the program's command line: commands, options, and values where those are
// words or files. They run nothing but the shell itself.

namespace penumbra::cli {

[[nodiscard]] std::string bash_completion(const CommandEntry& program);
[[nodiscard]] std::string zsh_completion(const CommandEntry& program);

}  // namespace penumbra::cli
