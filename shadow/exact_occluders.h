#pragma once

#include <memory>

#include "core/frame/scene_view.h"
#include "core/parallel/arena.h"
#include "core/simd/isa.h"
#include "shadow/ray_stream.h"

// Occluders whose answers are those of real numbers (segment_triangle.h), the same on all
// processors: triangles in world space, tested by our own arithmetic.

namespace penumbra::shadow {

class ExactOccluders {
  public:
    // As Occluders. `isa` changes no answer.
    ExactOccluders(const parallel::Arena& arena, simd::Isa isa);
    ~ExactOccluders();
    ExactOccluders(const ExactOccluders&) = delete;
    ExactOccluders& operator=(const ExactOccluders&) = delete;

    // Forgets all trees and builds those of the view's fixed models.
    void rebuild(const SceneView& view);
    // Builds the trees of moving models where their transforms have changed.
    void place_moving(const SceneView& view);
    // 0 <= near <= far <= 2^20.
    void occlude(const RayStream& rays) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace penumbra::shadow
