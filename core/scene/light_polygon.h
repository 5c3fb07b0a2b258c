#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/math/vec.h"

// Geometry of the polygons that emit.

namespace penumbra {

// Twice the area times the unit normal of the side from which the vertices run counter-clockwise
// (Newell's sum; exact for planar polygons, the best fit for others).
[[nodiscard]] Vec3d newell_normal(std::span<const Vec3d> vertices);

// What is wrong with a polygon as a light: an area of zero, a vertex off the plane, a corner that
// is not convex. Nothing, if nothing is. Tolerances are relative to the polygon's size.
[[nodiscard]] std::optional<std::string> polygon_problem(std::span<const Vec3d> vertices);

}  // namespace penumbra
