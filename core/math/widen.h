#pragma once

#include "core/math/vec.h"

namespace penumbra {

// Scenes are kept in float and evaluated in double.
inline Vec3d widen(const Vec3f& v) {
    return {v.x, v.y, v.z};
}
inline Vec3f narrow(const Vec3d& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace penumbra
