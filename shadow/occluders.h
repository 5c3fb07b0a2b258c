#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/parallel/arena.h"
#include "core/scene/scene_view.h"
#include "core/simd/isa.h"
#include "shadow/ray_stream.h"
#include "shadow/trace_isa.h"

// The geometry that blocks light.

namespace penumbra::shadow {

// Who decides whether a ray meets a triangle.
enum class HitTest {
    kEmbree,  // fastest; the last bits depend on its instruction set and the processor's maker
    kExact,   // segment_triangle.h: the same answer on all processors
};

// Building a tree takes two threads 0.3 us per triangle; where models are instances instead, each
// ray takes them 0.05 us longer. So moving triangles are worth a tree of their own in each frame
// that has six rays for each; so many are asked for to be sure.
inline constexpr std::size_t kRaysPerRebuiltTriangle = 16;

struct OccluderSettings {
    TraceIsa isa = TraceIsa::kAvx2;  // of kEmbree
    HitTest test = HitTest::kEmbree;
    std::optional<simd::Isa> kernels;  // of kExact; changes no answer
    // Of kEmbree: moving models with so many triangles together, the smallest first, are put into
    // one tree in world space, anew for each frame; the others are instances, which are slower to
    // trace.
    std::size_t most_rebuilt = 1 << 16;
};

class Occluders {
  public:
    // Uses the arena's threads, and no others, to build. `arena` must outlive it.
    Occluders(const parallel::Arena& arena, const OccluderSettings& settings);
    Occluders(const parallel::Arena& arena, TraceIsa isa)
        : Occluders(arena, OccluderSettings{.isa = isa}) {}
    ~Occluders();
    Occluders(const Occluders&) = delete;
    Occluders& operator=(const Occluders&) = delete;

    // Makes the geometry that of `view`; rebuilds only what moved since the last call. Keeps
    // pointers into the view and its meshes and textures: they must stay where they are until the
    // next update. The result depends on the view alone, not on earlier ones. Throws OutputError if
    // memory is short.
    void update(const SceneView& view);

    // Marks blocked rays. Any number of threads may call it at once. 0 <= near < far <= 2^20.
    void occlude(const RayStream& rays) const;

    // Per instance: the size of the numbers, metres, whose rounding errors a ray's origin must be
    // offset for, beside those of its own coordinates. See rays.h.
    [[nodiscard]] std::span<const float> offset_scales() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace penumbra::shadow
