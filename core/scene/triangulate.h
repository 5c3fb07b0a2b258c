#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/vec.h"

namespace penumbra {

// Faces with more corners are refused by the readers.
inline constexpr std::size_t kMaxFaceCorners = 10000;

// Cuts a simple polygon, convex or not, planar or nearly so, into corners - 2 triangles with the
// polygon's winding. The result holds indices into `corners`. Collinear corners end up at triangles
// with an area where that is possible, so that no T-junction arises. Polygons that cross themselves
// give some triangles.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3f> corners);

}  // namespace penumbra
