#pragma once

#include "core/scene/scene.h"

namespace penumbra {

// A camera that sees all models at time 0 from three quarters: from the front, the right and a
// little above, with the film's aspect.
[[nodiscard]] CameraTracks framing_camera(const Scene& scene);

// A large rect to the left, above and in front of the models, facing them: exposes surfaces of
// medium grey well, whatever the size of the scene.
[[nodiscard]] Light default_light(const Scene& scene);

// A track that stands still.
template <class T>
[[nodiscard]] Track<T> constant(const T& value) {
    return {{{0, value}}};
}

}  // namespace penumbra
