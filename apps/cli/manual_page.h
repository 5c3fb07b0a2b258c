#pragma once

#include <string>

#include "apps/cli/command_table.h"

namespace penumbra::cli {

// The program's manual page, penumbra(1), for man and groff. It holds no date: the same program
// writes the same page.
[[nodiscard]] std::string manual_page(const CommandEntry& program, const std::string& version);

}  // namespace penumbra::cli
