#pragma once

#include <filesystem>
#include <vector>

#include "apps/check/accept_command.h"
#include "apps/check/outcome.h"

namespace penumbra::check {

// One page that needs nothing but itself: per check its verdict, the new picture or, where it
// differs, new, golden and difference; the commands that accept. What failed comes first. Throws
// OutputError.
void write_html_report(const std::filesystem::path& target,
                       const std::vector<CheckOutcome>& outcomes, const Invocation& invocation);

}  // namespace penumbra::check
