#pragma once

#include <cstdint>

#include "apps/check/selection.h"
#include "apps/check/settings.h"

namespace penumbra::check {

// Bytes that a render will need at most, from its frame's size and its models' files. Never too
// little for scenes of models; a scene that cannot be read needs next to nothing.
[[nodiscard]] std::uint64_t estimated_bytes(const Check& check, const CheckSettings& settings);

// Bytes that renders may share now: what the machine, and the cgroups this process is in, have
// left.
[[nodiscard]] std::uint64_t available_bytes();

}  // namespace penumbra::check
