#pragma once

#include <memory>

#include "core/frame/scene_view.h"
#include "core/parallel/arena.h"
#include "shadow/ray_stream.h"
#include "shadow/trace_isa.h"

// Occluders that Embree finds.

namespace penumbra::shadow {

class EmbreeOccluders {
  public:
    // As Occluders. `most_rebuilt`: triangles of moving models, see OccluderSettings.
    EmbreeOccluders(const parallel::Arena& arena, TraceIsa isa, std::size_t most_rebuilt);
    ~EmbreeOccluders();
    EmbreeOccluders(const EmbreeOccluders&) = delete;
    EmbreeOccluders& operator=(const EmbreeOccluders&) = delete;

    // Forgets all trees and builds those of fixed models and of large ones.
    void rebuild(const SceneView& view);
    // Puts moving models where they are now.
    void place_moving(const SceneView& view);
    // 0 <= near < far <= 2^20.
    void occlude(const RayStream& rays) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace penumbra::shadow
