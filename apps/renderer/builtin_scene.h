#pragma once

#include "core/scene/scene.h"

namespace penumbra::renderer {

// The scene that is rendered when none is named: data/scenes/turntable, embedded in the program.
[[nodiscard]] Scene read_builtin_scene();

// Of its files; 32 hexadecimal digits.
[[nodiscard]] std::string builtin_scene_digest();

}  // namespace penumbra::renderer
