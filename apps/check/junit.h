#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/check/outcome.h"

namespace penumbra::check {

// Text inside XML 1.0, attributes included: what XML cannot hold (control characters, broken UTF-8)
// becomes U+FFFD.
[[nodiscard]] std::string xml_escaped(std::string_view text);

// JUnit XML as GitLab, GitHub's reporters and Jenkins read it: a test case per check, comparisons
// and goldens as <failure>, everything else that went wrong as <error>.
[[nodiscard]] std::string junit_xml(const std::vector<CheckOutcome>& outcomes, double seconds);

}  // namespace penumbra::check
