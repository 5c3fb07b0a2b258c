#pragma once

#include <memory>
#include <vector>

#include "core/parallel/arena.h"
#include "core/scene/scene_view.h"
#include "shadow/trace_isa.h"

// The ray tracer by itself: Embree on the same triangles, without our packing, filters or
// instances. What our passes are measured against: apps/bench and the benchmarks ask for it, no
// pass of a frame does. It stands here because no other room may name Embree.

namespace penumbra::shadow {

// How rays are handed over.
enum class RayCall { kSingle, kPacket8, kPacket16, kStream };
[[nodiscard]] const char* name(RayCall call);

// The calls that can find whether rays are blocked, and what they hit first. Which of them are
// there depends on Embree's version.
[[nodiscard]] std::vector<RayCall> occlude_calls();
[[nodiscard]] std::vector<RayCall> intersect_calls();

// Rays as structure of arrays.
struct RayBatch {
    std::vector<float> origin_x, origin_y, origin_z, direction_x, direction_y, direction_z,
        far_limit;
    int count = 0;  // without the padding

    void add(const Vec3f& origin, const Vec3f& direction, float far);
    void pad();  // with rays that cannot hit, to a multiple of 16: before it is traced
    [[nodiscard]] int size() const { return static_cast<int>(far_limit.size()); }
};

// One worker's memory.
struct RayCallScratch {
    std::vector<float> near_limit, far_limit;
};

// All triangles of a scene in world space: robust mode, medium quality, as the occluders.
class BareRays {
  public:
    // Uses the arena's threads, and no others, to build.
    BareRays(const SceneView& view, TraceIsa isa, const parallel::Arena& arena);
    ~BareRays();
    BareRays(const BareRays&) = delete;
    BareRays& operator=(const BareRays&) = delete;

    // Finds which rays are blocked; returns how many.
    int occlude(const RayBatch& batch, RayCall call, RayCallScratch& scratch) const;
    // Finds each ray's nearest triangle; returns how many hit one.
    int intersect(const RayBatch& batch, RayCall call) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace penumbra::shadow
