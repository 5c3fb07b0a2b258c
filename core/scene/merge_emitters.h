#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/scene.h"

namespace penumbra {

// Joins triangles of a mesh to as few lights as is easy: adjacent ones (sharing an edge, by
// coordinates, of opposite direction) in one plane that form a convex polygon of at most
// kMaxLightVertices vertices, not counting those on straight edges. Every triangle is in exactly
// one of the polygons, whose vertices run as the triangles' do. `triangles` are indices into
// mesh.triangles.
[[nodiscard]] std::vector<LightPolygon> merge_emitters(const Mesh& mesh,
                                                       std::span<const std::uint32_t> triangles);

}  // namespace penumbra
