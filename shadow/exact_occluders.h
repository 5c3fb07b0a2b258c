#pragma once

#include <memory>

#include "core/parallel/arena.h"
#include "core/simd/isa.h"
#include "shadow/occluder_trees.h"

namespace penumbra::shadow {

// Occluders whose answers are those of real numbers (segment_triangle.h), the same on all
// processors: triangles in world space, tested by our own arithmetic. `isa` changes no answer;
// `arena` must outlive them.
[[nodiscard]] std::unique_ptr<OccluderTrees> make_exact_occluders(const parallel::Arena& arena,
                                                                  simd::Isa isa);

}  // namespace penumbra::shadow
