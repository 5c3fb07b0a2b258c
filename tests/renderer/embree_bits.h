#pragma once

#include <string>
#include <vector>

#include "core/scene/scene_view.h"
#include "shadow/embree.h"

// Which rays are blocked, according to Embree by itself with any of its instruction sets and forms
// of call, and according to the exact test.

namespace penumbra::tests {

struct EmbreeRay {
    Vec3f origin, direction;
    float far_limit;
};

// The names of Embree's instruction sets that this machine can run.
std::vector<std::string> embree_isas();

class BareEmbree {
  public:
    BareEmbree(const SceneView& view, const std::string& isa);
    ~BareEmbree();
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;

    // `rays_per_call` is 1, 8, or 0 for a stream.
    [[nodiscard]] std::vector<bool> blocked(const std::vector<EmbreeRay>& rays,
                                            int rays_per_call) const;

  private:
    RTCDeviceTy* device_;
    RTCSceneTy* scene_;
};

std::vector<bool> exactly_blocked(const SceneView& view, const std::vector<EmbreeRay>& rays);

}  // namespace penumbra::tests
