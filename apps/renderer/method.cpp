#include "apps/renderer/method.h"

#include <algorithm>
#include <iterator>

#include "core/error.h"

namespace penumbra::renderer {
namespace {

using denoise::Estimator;
using denoise::NoiseOf;

constexpr Plan kPlans[] = {
    {.method = Method::kRatio,
     .needs_occluders = true,
     .needs_rays = true,
     .estimator = Estimator::kRatio,
     .noise_of = NoiseOf::kShadow,
     .denoise = Denoise::kNoiseDriven},
    {.method = Method::kStochastic,
     .needs_occluders = true,
     .needs_rays = true,
     .estimator = Estimator::kStochastic,
     .noise_of = NoiseOf::kLight,
     .denoise = Denoise::kNone},
    {.method = Method::kUnshadowed,
     .needs_occluders = false,
     .needs_rays = false,
     .estimator = Estimator::kUnshadowed,
     .noise_of = NoiseOf::kShadow,
     .denoise = Denoise::kNone},
};

}  // namespace

const Plan& plan_of(Method method) {
    const Plan* const plan = std::ranges::find(kPlans, method, &Plan::method);
    PENUMBRA_ASSERT(plan != std::end(kPlans), "method {}", static_cast<int>(method));
    return *plan;
}

}  // namespace penumbra::renderer
