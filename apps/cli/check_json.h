#pragma once

#include <string>
#include <vector>

#include "apps/check/outcome.h"

namespace penumbra::cli {

// The results of `penumbra check` for programs.
[[nodiscard]] std::string check_json(const std::vector<check::CheckOutcome>& outcomes,
                                     const std::string& accept_command);

}  // namespace penumbra::cli
