#pragma once

#include <optional>
#include <string>

#include "core/scene/scene.h"

namespace penumbra {

// What keeps the camera from having a frame at a time: eye and target coincide, or up is parallel
// to the view direction. Nothing, if nothing does.
[[nodiscard]] std::optional<std::string> camera_problem(const CameraTracks& camera, double time);

}  // namespace penumbra
