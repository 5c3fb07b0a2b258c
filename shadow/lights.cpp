#include "shadow/lights.h"

#include <algorithm>
#include <numeric>

#include "shadow/light_bounds_kernel.h"

namespace penumbra::shadow {
namespace {

// Up to this many lights are all kept: choosing would cost more than it could save.
constexpr std::size_t kFewLights = 3;

using BlockSums = std::array<double, kBlocks>;

// The largest share of a block's light that a light may add; infinite where nothing is certain.
float rank(const float* upper, const BlockSums& total_lower) {
    float largest = 0;
    for (std::size_t b = 0; b < kBlocks; ++b) {
        if (upper[b] <= 0) continue;
        const double share = total_lower[b] > 0 ? upper[b] / total_lower[b] : 1e30;
        largest = std::max(largest, static_cast<float>(std::min(share, 1e30)));
    }
    return largest;
}

// Moves a light from the kept to the culled ones if the guarantee still holds in every block.
bool try_to_cull(const float* upper, const float* lower, double tolerance, BlockSums& culled,
                 BlockSums& kept) {
    BlockSums new_culled = culled, new_kept = kept;
    for (std::size_t b = 0; b < kBlocks; ++b) {
        new_culled[b] += upper[b];
        new_kept[b] -= lower[b];
        // The sums are rounded, to 1e-13 of what was ever in them.
        if (new_culled[b] > 0 && new_culled[b] > tolerance * (new_kept[b] * (1 - 1e-9)))
            return false;
    }
    culled = new_culled;
    kept = new_kept;
    return true;
}

}  // namespace

void cull_lights(const SceneView& view, const FrameContext& context,
                 const ConstSurfaceView& surface, float tolerance, TileLights& tile) {
    const std::size_t count = view.lights.size();
    tile.kept_.resize(count);
    std::iota(tile.kept_.begin(), tile.kept_.end(), 0u);
    if (count <= kFewLights || !(tolerance > 0)) return;

    tile.upper_.resize(count * kBlocks);
    tile.lower_.resize(count * kBlocks);
    simd::pick(context.isa, &avx2::bound_lights,
               &avx512::bound_lights)({.lights = view.lights.view(),
                                       .eye = view.camera.eye,
                                       .surface = surface,
                                       .upper = tile.upper_.data(),
                                       .lower = tile.lower_.data()});

    BlockSums kept{}, culled{};
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t b = 0; b < kBlocks; ++b) kept[b] += tile.lower_[i * kBlocks + b];
    tile.rank_.resize(count);
    tile.order_.clear();
    for (std::size_t i = 0; i < count; ++i) {
        tile.rank_[i] = rank(&tile.upper_[i * kBlocks], kept);
        if (tile.rank_[i] > 0 && tile.rank_[i] <= tolerance)
            tile.order_.push_back(static_cast<std::uint32_t>(i));
    }
    std::sort(tile.order_.begin(), tile.order_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return tile.rank_[a] != tile.rank_[b] ? tile.rank_[a] < tile.rank_[b] : a < b;
    });
    for (const std::uint32_t i : tile.order_)
        if (try_to_cull(&tile.upper_[i * kBlocks], &tile.lower_[i * kBlocks], tolerance, culled,
                        kept))
            tile.rank_[i] = 0;
    std::erase_if(tile.kept_, [&](std::uint32_t i) { return tile.rank_[i] <= 0; });
}

}  // namespace penumbra::shadow
