#include "shadow/rays.h"

#include <bit>

#include "core/error.h"
#include "shadow/rays_kernel.h"

namespace penumbra::shadow {
namespace {

Plane<float> tile_plane() {
    return Plane<float>(kTileSize, kTileSize);
}

RayKernelInputs kernel_inputs(const RayInputs& inputs, const LightSample& sample) {
    RayKernelInputs kernel;
    kernel.inputs = &inputs;
    kernel.lights = sample.lights;
    kernel.light = sample.light;
    kernel.shares = share_samples(sample.count);
    kernel.from_brdf = sample.index >= kernel.shares.light;
    const int index = kernel.from_brdf ? sample.index - kernel.shares.light : sample.index;
    const int count = kernel.from_brdf ? kernel.shares.brdf : kernel.shares.light;
    const std::uint32_t dimension = 2 * sample.light + (kernel.from_brdf ? 1 : 0);
    kernel.sequence = make_sequence(inputs.frame, dimension, count);
    kernel.sample_in_technique = static_cast<std::uint32_t>(index);
    static constexpr float kNoInstances = 0;
    kernel.offset_scales =
        inputs.offset_scales.empty() ? &kNoInstances : inputs.offset_scales.data();
    return kernel;
}

}  // namespace

RayScratch::RayScratch()
    : origin(make_plane3<float>(kTileSize, kTileSize)),
      direction(make_plane3<float>(kTileSize, kTileSize)),
      range(tile_plane()),
      weight(make_plane3<float>(kTileSize, kTileSize)),
      packed{tile_plane(), tile_plane(), tile_plane(), tile_plane(),
             tile_plane(), tile_plane(), tile_plane(), tile_plane()} {}

std::uint64_t RayScratch::count_active() const {
    std::uint64_t count = 0;
    for (const std::uint64_t row : active) count += static_cast<unsigned>(std::popcount(row));
    return count;
}

void generate_rays(const RayInputs& inputs, const LightSample& sample, RayScratch& scratch) {
    PENUMBRA_ASSERT(sample.index >= 0 && sample.index < sample.count, "sample {} of {}",
                    sample.index, sample.count);
    const RayKernelInputs kernel = kernel_inputs(inputs, sample);
    simd::pick(inputs.frame.isa, &avx2::generate_rays, &avx512::generate_rays)(kernel, scratch);
}

}  // namespace penumbra::shadow
