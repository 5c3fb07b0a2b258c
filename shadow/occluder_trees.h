#pragma once

#include "core/scene/scene_view.h"
#include "shadow/ray_stream.h"

namespace penumbra::shadow {

// One way to find what blocks a ray: trees of all models, and who asks them.
class OccluderTrees {
  public:
    OccluderTrees() = default;
    virtual ~OccluderTrees() = default;
    OccluderTrees(const OccluderTrees&) = delete;
    OccluderTrees& operator=(const OccluderTrees&) = delete;

    // Forgets all trees and builds those that stay as they are while nothing but transforms of
    // moving models changes.
    virtual void rebuild(const SceneView& view) = 0;
    // Puts moving models where they are now.
    virtual void place_moving(const SceneView& view) = 0;
    // Marks blocked rays. Any number of threads may call it at once. 0 <= near < far <= 2^20.
    virtual void occlude(const RayStream& rays) const = 0;
};

}  // namespace penumbra::shadow
