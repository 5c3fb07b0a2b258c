#pragma once

#include "raster/bins.h"

namespace penumbra::raster {

// The part of a triangle inside near plane and guard band, snapped, in the triangle's order of
// vertices; at least 3 vertices, or 0 where nothing is left. Vertices are in view space. Two
// triangles that share an edge get the same points on it, whichever way they run along it: a new
// point is always computed from the edge's lower end (by x, then y, then z) to its upper.
int clip_triangle(const Camera& camera, const Vec3f (&view)[3],
                  SnappedVertex (&clipped)[kMaxClippedTriangleVertices]);

}  // namespace penumbra::raster
