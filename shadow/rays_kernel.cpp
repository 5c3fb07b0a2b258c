#include "shadow/rays_kernel.h"

#include "core/bsdf/ggx.h"
#include "core/frame/visibility.h"
#include "core/math/frame.h"
#include "core/sampling/polygon.h"
#include "core/simd/kernel.h"
#include "shadow/ray_origin.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

using Vec = Vec3<F>;

Vec load_vector(const PlaneView3<const float>& planes, int x, int y) {
    return {simd::load<F>(planes[0].row(y) + x), simd::load<F>(planes[1].row(y) + x),
            simd::load<F>(planes[2].row(y) + x)};
}

void store_vector(Plane3<float>& planes, int x, int y, const Vec& value) {
    simd::store(planes[0].row(y) + x, value.x);
    simd::store(planes[1].row(y) + x, value.y);
    simd::store(planes[2].row(y) + x, value.z);
}

// What the light does at some pixels, whichever sample is taken.
struct Setting {
    Vec position, normal;
    SeenPolygon<F> seen;
    PolygonSampler<F> sampler;
    M lit;
};

// A point of the light, and what light from there is worth.
struct Sample {
    Vec place;  // relative to the light's first vertex
    Vec weight;
    M useful;
};

Vec2<F> random_numbers(const RayKernelInputs& kernel, int x, int y) {
    const Tile& tile = kernel.inputs->tile;
    const U pixel_x = U(static_cast<std::uint32_t>(tile.x0 + x)) + simd::iota<U>();
    const U pixel_y = U(static_cast<std::uint32_t>(tile.y0 + y));
    return sequence_point<F>(kernel.sequence, pixel_x, pixel_y, kernel.sample_in_technique);
}

Brdf<F> load_brdf(const ConstSurfaceView& surface, int x, int y) {
    return make_brdf(load_vector(surface.base_color, x, y),
                     simd::load<F>(surface.roughness.row(y) + x),
                     simd::load<F>(surface.metallic.row(y) + x),
                     simd::load<F>(surface.dielectric_f0.row(y) + x));
}

Sample take_sample(const RayKernelInputs& kernel, const Setting& setting, int x, int y) {
    const ConstSurfaceView& surface = kernel.inputs->surface;
    const Brdf<F> brdf = load_brdf(surface, x, y);
    const Frame<F> frame = frame_from_normal(setting.normal);
    const Vec view = frame.to_local(normalize(broadcast<F>(kernel.inputs->eye) - setting.position));
    const Vec2<F> random = random_numbers(kernel, x, y);
    Sample sample;
    sample.useful = setting.lit;
    sample.place = sample_polygon(kernel.shape, setting.seen, setting.sampler, random);
    const Vec direction = frame.to_local(normalize(setting.seen.vertices[0] + sample.place));
    const GgxLobe<F> lobe = ggx_evaluate(brdf.alpha, view, direction);
    const F light_density = F(1) / simd::select(setting.lit, setting.sampler.solid_angle, F(1));
    const F factor = balance_factor(F(static_cast<float>(kernel.shares.light)), light_density,
                                    F(static_cast<float>(kernel.shares.brdf)), lobe.density);
    const Vec reflected = lambert_times_cosine(brdf.diffuse_albedo, direction.z) +
                          ggx_specular_times_cosine(lobe, brdf.f0);
    sample.weight = reflected * broadcast<F>(kernel.radiance) * factor;
    return sample;
}

// The ray from the surface to a place on the light, ending short of the light's plane.
void store_ray(const RayKernelInputs& kernel, const Vec& place, int x, int y,
               shadow::RayScratch& scratch) {
    const ConstSurfaceView& surface = kernel.inputs->surface;
    const U instance = simd::load<U>(surface.instance.row(y) + x);
    const I index = I(simd::select(instance == U(kNothing), U(0u), instance));
    const F scale = simd::gather(kernel.offset_scales, index);
    const Vec origin = offset_origin(load_vector(surface.shadow_origin, x, y),
                                     load_vector(surface.geometric_normal, x, y), scale,
                                     broadcast<F>(kernel.inputs->eye));
    const Vec to_vertex = broadcast<F>(kernel.shape.vertices[0]) - origin;
    const F height = simd::abs(dot(broadcast<F>(kernel.shape.normal), to_vertex));
    store_vector(scratch.origin, x, y, origin);
    store_vector(scratch.direction, x, y, to_vertex + place);
    simd::store(scratch.range.row(y) + x, range_to_light(height, F(kernel.range_margin)));
}

[[gnu::flatten]] std::uint32_t generate_lanes(const RayKernelInputs& kernel, int x, int y,
                             shadow::RayScratch& scratch) {
    const ConstSurfaceView& surface = kernel.inputs->surface;
    const M hit = simd::load<U>(surface.material.row(y) + x) != U(kNothing);
    if (simd::none(hit)) return 0;
    Setting setting;
    setting.position = load_vector(surface.position, x, y);
    setting.normal = load_vector(surface.normal, x, y);
    setting.seen = see_polygon(kernel.shape, setting.position, setting.normal);
    setting.seen.lit &= hit;
    if (simd::none(setting.seen.lit)) return 0;
    setting.sampler = make_polygon_sampler(kernel.shape, setting.seen);
    setting.lit = setting.seen.lit & (setting.sampler.solid_angle > F(0));
    const Sample sample = take_sample(kernel, setting, x, y);
    const M useful = sample.useful & (sample.weight.x + sample.weight.y + sample.weight.z > F(0));
    store_ray(kernel, sample.place, x, y, scratch);
    const Vec nothing = {F(0), F(0), F(0)};
    store_vector(scratch.weight, x, y, select(useful, sample.weight, nothing));
    return simd::bits(useful);
}

}  // namespace

void generate_rays(const RayKernelInputs& kernel, shadow::RayScratch& scratch) {
    for (int y = 0; y < kTileSize; ++y) {
        std::uint64_t active = 0;
        for (int x = 0; x < kTileSize; x += kLanes)
            active |= static_cast<std::uint64_t>(generate_lanes(kernel, x, y, scratch)) << x;
        scratch.active[y] = active;
    }
}

}  // namespace penumbra::PENUMBRA_ISA
