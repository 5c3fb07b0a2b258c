#pragma once

#include <set>
#include <string>
#include <vector>

#include "apps/diff/pairs.h"

namespace penumbra::diff {

// Those of the layers that no file of the pairs has, as far as headers tell: none where a file
// cannot be read. Reads no pixel, and no more headers than it needs.
[[nodiscard]] std::vector<std::string> find_unknown_layers(const std::vector<FilePair>& pairs,
                                                           const std::set<std::string>& layers);

}  // namespace penumbra::diff
