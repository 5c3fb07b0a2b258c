#pragma once

#include <vector>

#include "core/json/node.h"
#include "core/scene/scene.h"

namespace penumbra {

// The scene file's `lights`: rects and polygons, checked at the times of their keys.
[[nodiscard]] std::vector<Light> read_lights(const json::Node& document);

}  // namespace penumbra
