#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/check/outcome.h"

namespace penumbra::check {

// A word as a POSIX shell takes it: quoted where it holds anything but letters, digits and what no
// shell looks at.
[[nodiscard]] std::string shell_quoted(std::string_view word);
[[nodiscard]] std::string shell_line(const std::vector<std::string>& words);

// How this run was started, as far as it matters to a second one.
struct Invocation {
    std::string program;                 // as the user called it
    std::vector<std::string> selection;  // what chose the checks: paths, filters
    std::vector<std::string> options;    // those that pixels may depend on
};

// The one command that makes the pictures of this run the goldens, to be pasted into a shell in the
// same folder; "" where nothing can be accepted.
[[nodiscard]] std::string accept_command(const Invocation& invocation,
                                         const std::vector<CheckOutcome>& outcomes);
// The same for one check alone.
[[nodiscard]] std::string accept_command(const Invocation& invocation, const CheckOutcome& outcome);

}  // namespace penumbra::check
