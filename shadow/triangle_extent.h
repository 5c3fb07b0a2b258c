#pragma once

#include "core/parallel/arena.h"
#include "core/scene/scene_view.h"

// How large the numbers are that a point on a model's triangles is made of: what a shadow ray's
// offset must be relative to.

namespace penumbra::shadow {

// In the world for fixed models, in the object's space for moving ones.
struct TriangleExtents {
    float edge = 0;        // the largest extent of a triangle along an axis
    float coordinate = 0;  // the largest magnitude of a coordinate
};

[[nodiscard]] TriangleExtents triangle_extents(const parallel::Arena& arena,
                                               const Instance& instance);

// Metres in the world. Rays into instances of moving models are transformed: their rounding grows
// with all of the object's coordinates and with its translation. In a tree in world space it is
// that of the edges, as for fixed models. The larger one, whichever tree the model is in.
[[nodiscard]] float offset_scale(const TriangleExtents& extents, const Instance& instance);

}  // namespace penumbra::shadow
