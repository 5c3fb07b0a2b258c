#pragma once

#include "core/light/light_set.h"
#include "core/sampling/mis.h"
#include "core/sampling/sequence.h"
#include "shadow/rays.h"

namespace penumbra {

// generate_rays with everything that all pixels share worked out.
struct RayKernelInputs {
    const shadow::RayInputs* inputs = nullptr;
    LightSetView lights;
    std::uint32_t light = 0;
    Sequence sequence;
    SampleShares shares;
    std::uint32_t sample_in_technique = 0;
    bool from_brdf = false;
    const float* offset_scales = nullptr;  // at least one element
};

namespace avx2 {
void generate_rays(const RayKernelInputs& inputs, shadow::RayScratch& scratch);
}  // namespace avx2
namespace avx512 {
void generate_rays(const RayKernelInputs& inputs, shadow::RayScratch& scratch);
}  // namespace avx512

}  // namespace penumbra
