#include "shadow/shade_kernel.h"

#include "core/frame/visibility.h"
#include "core/image/plane_lanes.h"
#include "core/simd/kernel.h"
#include "shadow/shade_point.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

[[gnu::flatten]] shadow::Unshadowed<F> shade_block(const shadow::ShadeJob& job, int x, int y) {
    const ConstSurfaceView& surface = job.surface;
    const shadow::ShadingPoint<F> point{load3<F>(surface.position, x, y),
                                        load3<F>(surface.normal, x, y),
                                        broadcast<F>(job.eye),
                                        load3<F>(surface.base_color, x, y),
                                        simd::load<F>(surface.roughness.row(y) + x),
                                        simd::load<F>(surface.metallic.row(y) + x),
                                        simd::load<F>(surface.dielectric_f0.row(y) + x)};
    shadow::ShadingLobes<F> lobes{};  // compilers cannot see that it is set before it is used
    shadow::ArrivingLight<F> sum;
    bool is_lit = false;
    for (int i = 0; i < job.kept_count; ++i) {
        with_light(job.lights, job.kept[i], [&](const auto& light) {
            const auto seen = see(light.shape, point.position, point.normal);
            if (!simd::any(seen.lit)) return;
            // The table is only asked where some light arrives.
            if (!is_lit) lobes = shadow::make_lobes(point);
            is_lit = true;
            shadow::add_light(light, seen, point.normal, lobes, job.accuracy, sum);
        });
    }
    return is_lit ? shadow::reflect(lobes, sum) : shadow::Unshadowed<F>{};
}

}  // namespace

void shade_tile(const shadow::ShadeJob& job) {
    const Vec3<F> zero{F(0), F(0), F(0)};
    for (int y = 0; y < kTileSize; ++y) {
        for (int x = 0; x < kTileSize; x += kLanes) {
            const M hit = simd::load<U>(job.surface.material.row(y) + x) != U(kNothing);
            shadow::Unshadowed<F> light;
            if (job.kept_count > 0 && simd::any(hit)) light = shade_block(job, x, y);
            store3(job.sums.unshadowed_diffuse, x, y, select(hit, light.diffuse, zero));
            store3(job.sums.unshadowed_glossy, x, y, select(hit, light.glossy, zero));
        }
    }
}

}  // namespace penumbra::PENUMBRA_ISA
