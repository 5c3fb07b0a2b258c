#pragma once

#include <memory>

#include "core/parallel/arena.h"
#include "shadow/occluder_trees.h"
#include "shadow/trace_isa.h"

namespace penumbra::shadow {

// Occluders that Embree finds. `most_rebuilt`: triangles of moving models, see OccluderSettings;
// `arena` must outlive them.
[[nodiscard]] std::unique_ptr<OccluderTrees> make_embree_occluders(const parallel::Arena& arena,
                                                                   TraceIsa isa,
                                                                   std::size_t most_rebuilt);

}  // namespace penumbra::shadow
