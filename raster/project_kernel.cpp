#include "raster/project_kernel.h"

#include "core/simd/kernel.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

using namespace raster;

I outcode(const ClipDistances<F>& distances) {
    const auto bit = [](F distance, Outcode code) {
        return simd::select(distance >= F(0), I(0), I(code));
    };
    return bit(distances.near_plane, kBeforeNear) | bit(distances.left, kLeftOfGuardBand) |
           bit(distances.right, kRightOfGuardBand) | bit(distances.top, kAboveGuardBand) |
           bit(distances.bottom, kBelowGuardBand);
}

Vec3<F> load_positions(const ProjectJob& job, int first) {
    const I vertex = simd::min(I(first) + simd::iota<I>(), I(job.vertex_count - 1));
    const I at = vertex * I(3);
    return {simd::gather(job.positions, at), simd::gather(job.positions + 1, at),
            simd::gather(job.positions + 2, at)};
}

}  // namespace

void project_vertices(const ProjectJob& job) {
    alignas(64) std::int32_t xs[kLanes];
    alignas(64) std::int32_t ys[kLanes];
    for (int first = job.begin; first < job.end; first += kLanes) {
        const Vec3<F> view = job.camera.view_from_world(load_positions(job, first));
        const I outside = outcode(clip_distances(job.camera, view));
        const Vec2<F> pixel = project(job.camera, view);
        const M snappable = outside == I(0);
        simd::store(xs, simd::select(snappable, snap(pixel.x), I(kUnsnappable) + outside));
        simd::store(ys, simd::select(snappable, snap(pixel.y), I(0)));
        for (int k = 0; k < kLanes; ++k) job.snapped[first + k] = {xs[k], ys[k]};
    }
}

}  // namespace penumbra::PENUMBRA_ISA
