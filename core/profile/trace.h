#pragma once

#include <string>
#include <string_view>

#include "core/profile/profile.h"

namespace penumbra::profile {

// The profile in the trace event format that Perfetto (ui.perfetto.dev) and chrome://tracing open:
// JSON, a track per thread, complete events ("ph": "X") with times in microseconds since the
// profile's first slice, idle ones included.
[[nodiscard]] std::string chrome_trace(const Profile& profile, std::string_view title);

}  // namespace penumbra::profile
