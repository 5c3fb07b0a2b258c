#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "core/frame/scene_view.h"
#include "core/parallel/arena.h"

// Embree by itself on the same geometry: the limit that our passes are measured against.

namespace penumbra::benchmarks {

// How rays are handed to Embree.
enum class Call { kSingle, kPacket8, kPacket16, kStream };
inline constexpr Call kCalls[] = {Call::kSingle, Call::kPacket8, Call::kPacket16, Call::kStream};
[[nodiscard]] const char* name(Call call);

// Rays of one tile, structure of arrays; room for a multiple of 16.
struct RayBatch {
    std::vector<float> origin_x, origin_y, origin_z, direction_x, direction_y, direction_z,
        far_limit;
    void add(const Vec3f& origin, const Vec3f& direction, float far);
    void pad();  // with rays that cannot hit, to a multiple of 16
    [[nodiscard]] int size() const { return static_cast<int>(far_limit.size()); }
    int count = 0;  // without the padding
};

class BareEmbree {
  public:
    // Robust mode, medium quality, the given instruction set ("avx2", "avx512").
    BareEmbree(const SceneView& view, const char* isa, int threads);
    ~BareEmbree();
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;

    // Seconds to find whether each ray is blocked; batches run in parallel.
    double occlude(const std::vector<RayBatch>& batches, Call call,
                   const parallel::Arena& arena) const;
    // Seconds to find each ray's nearest triangle.
    double intersect(const std::vector<RayBatch>& batches, Call call,
                     const parallel::Arena& arena) const;

  private:
    RTCDevice device_;
    RTCScene scene_;
};

}  // namespace penumbra::benchmarks
