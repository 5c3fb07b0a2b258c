#include "shadow/rays_kernel.h"

#include <new>

#include "core/bsdf/ggx.h"
#include "core/frame/visibility.h"
#include "core/image/plane_lanes.h"
#include "core/math/frame.h"
#include "core/simd/kernel.h"
#include "shadow/light_kinds.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

using Vec = Vec3<F>;

// Some neighbouring pixels on the way through the stages below. A row of a tile goes through each
// stage before the next begins: the stages are long chains of dependent operations, and short loops
// over them let the processor work on several blocks at once (a fifth less time than block by
// block).
template <class Shape>
struct Block {
    int x = 0;
    M lit;
    Vec position, normal;
    typename LightTypes<Shape, F>::Seen seen;
    typename LightTypes<Shape, F>::Sampler sampler;
    Vec2<F> random;
    Vec begun;            // half the way to the place: see begin_place
    Vec place;            // of the sample, relative to place_origin
    Vec view, direction;  // of eye and sample, in the frame of the shading normal
    Brdf<F> brdf;
};

// Constructs in place what `make` returns: an assignment would copy kilobytes of lanes.
template <class T, class Make>
[[gnu::always_inline]] inline void emplace(T& target, const Make& make) {
    ::new (static_cast<void*>(&target)) T(make());
}

// The light as these pixels see it; false where it gives them nothing.
template <class Shape>
[[gnu::flatten]] bool see_light(const RayKernelInputs& kernel, const Shape& shape, int y,
                                Block<Shape>& block) {
    const ConstSurfaceView& surface = kernel.inputs->surface;
    const M hit = simd::load<U>(surface.material.row(y) + block.x) != U(kNothing);
    if (simd::none(hit)) return false;
    block.position = load3<F>(surface.position, block.x, y);
    block.normal = load3<F>(surface.normal, block.x, y);
    emplace(block.seen, [&] { return see(shape, block.position, block.normal); });
    block.seen.lit &= hit;
    return simd::any(block.seen.lit);
}

template <class Shape>
[[gnu::flatten]] void measure_light(const Shape& shape, Block<Shape>& block) {
    emplace(block.sampler, [&] { return measure(shape, block.seen); });
    block.lit = block.seen.lit & has_places(block.sampler);
}

Vec2<F> random_numbers(const RayKernelInputs& kernel, int x, int y) {
    const Tile& tile = kernel.inputs->tile;
    const U pixel_x = U(static_cast<std::uint32_t>(tile.x0 + x)) + simd::iota<U>();
    const U pixel_y = U(static_cast<std::uint32_t>(tile.y0 + y));
    return sequence_point<F>(kernel.sequence, pixel_x, pixel_y, kernel.sample_in_technique);
}

template <class Shape>
void load_material(const RayKernelInputs& kernel, int y, Block<Shape>& block,
                   const Frame<F>& frame) {
    const ConstSurfaceView& surface = kernel.inputs->surface;
    const int x = block.x;
    block.brdf =
        make_brdf(load3<F>(surface.base_color, x, y), simd::load<F>(surface.roughness.row(y) + x),
                  simd::load<F>(surface.metallic.row(y) + x),
                  simd::load<F>(surface.dielectric_f0.row(y) + x));
    block.view = frame.to_local(normalize(broadcast<F>(kernel.inputs->eye) - block.position));
}

// A point of the light, in three stages.
template <class Shape>
[[gnu::flatten]] void begin_choice(const RayKernelInputs& kernel, const Shape& shape, int y,
                                   Block<Shape>& block) {
    block.random = random_numbers(kernel, block.x, y);
    block.begun = begin_place(shape, block.seen, block.sampler, block.random.x);
}
template <class Shape>
[[gnu::flatten]] void end_choice(const RayKernelInputs& kernel, const Shape& shape, int y,
                                 Block<Shape>& block) {
    load_material(kernel, y, block, frame_from_normal(block.normal));
    block.place = end_place(shape, block.seen, block.sampler, block.begun, block.random.y);
}
template <class Shape>
[[gnu::flatten]] void look_at_place(Block<Shape>& block) {
    const Frame<F> frame = frame_from_normal(block.normal);
    block.direction = frame.to_local(normalize(place_origin(block.seen) + block.place));
}

// The same, by the BRDF's visible normals: where the reflected direction meets the light, if it
// does.
template <class Shape>
[[gnu::flatten]] void choose_by_brdf(const RayKernelInputs& kernel, const Shape& shape, int y,
                                     Block<Shape>& block) {
    const Vec2<F> random = random_numbers(kernel, block.x, y);
    const Frame<F> frame = frame_from_normal(block.normal);
    load_material(kernel, y, block, frame);
    block.direction = ggx_sample_direction(block.brdf.alpha, block.view, random);
    const auto meets = intersect(shape, block.seen, frame.to_world(block.direction));
    block.lit &= meets.hit & (block.direction.z > F(0));
    block.place = meets.place;
}

// BRDF cosine radiance / density, over the number of samples. Returns which pixels get a ray.
template <class Shape>
[[gnu::flatten]] std::uint32_t weigh(const RayKernelInputs& kernel, const Lit<Shape>& light, int y,
                                     const Block<Shape>& block, shadow::RayScratch& scratch) {
    const GgxLobe<F> lobe = ggx_evaluate(block.brdf.alpha, block.view, block.direction);
    const F light_density =
        place_density(light.shape, block.seen, block.sampler, block.place, block.lit);
    const F factor = balance_factor(F(static_cast<float>(kernel.shares.light)), light_density,
                                    F(static_cast<float>(kernel.shares.brdf)), lobe.density);
    const Vec reflected = lambert_times_cosine(block.brdf.diffuse_albedo, block.direction.z) +
                          ggx_specular_times_cosine(lobe, block.brdf.f0);
    const Vec weight = reflected * broadcast<F>(light.emission.radiance) * factor;
    const M useful = block.lit & (weight.x + weight.y + weight.z > F(0));
    const Vec nothing = {F(0), F(0), F(0)};
    store3(scratch.weight, block.x, y, select(useful, weight, nothing));
    return simd::bits(useful);
}

// The ray from the surface to the sample, ending short of the light.
template <class Shape>
[[gnu::flatten]] void store_ray(const RayKernelInputs& kernel, const Shape& shape, int y,
                                const Block<Shape>& block, shadow::RayScratch& scratch) {
    const ConstSurfaceView& surface = kernel.inputs->surface;
    const int x = block.x;
    const U instance = simd::load<U>(surface.instance.row(y) + x);
    const I index = I(simd::select(instance == U(kNothing), U(0u), instance));
    const F scale = simd::gather(kernel.offset_scales, index);
    const Vec origin = offset_origin(load3<F>(surface.shadow_origin, x, y),
                                     load3<F>(surface.geometric_normal, x, y), scale,
                                     broadcast<F>(kernel.inputs->eye));
    const Vec to_light = place_origin<F>(shape) - origin;
    store3(scratch.origin, x, y, origin);
    store3(scratch.direction, x, y, to_light + block.place);
    simd::store(scratch.range.row(y) + x, end_of_ray(shape, to_light));
}

// Returns which pixels of the row get a ray.
template <class Shape>
std::uint64_t generate_row(const RayKernelInputs& kernel, const Lit<Shape>& light, int y,
                           shadow::RayScratch& scratch) {
    const Shape& shape = light.shape;
    Block<Shape> blocks[kTileSize / kLanes];
    int count = 0;
    for (int x = 0; x < kTileSize; x += kLanes) {
        blocks[count].x = x;
        if (see_light(kernel, shape, y, blocks[count])) ++count;
    }
    for (int i = 0; i < count; ++i) measure_light(shape, blocks[i]);
    if (kernel.from_brdf) {
        for (int i = 0; i < count; ++i) choose_by_brdf(kernel, shape, y, blocks[i]);
    } else {
        for (int i = 0; i < count; ++i) begin_choice(kernel, shape, y, blocks[i]);
        for (int i = 0; i < count; ++i) end_choice(kernel, shape, y, blocks[i]);
        for (int i = 0; i < count; ++i) look_at_place(blocks[i]);
    }
    std::uint64_t active = 0;
    for (int i = 0; i < count; ++i)
        active |= static_cast<std::uint64_t>(weigh(kernel, light, y, blocks[i], scratch))
                  << blocks[i].x;
    for (int i = 0; i < count; ++i) store_ray(kernel, shape, y, blocks[i], scratch);
    return active;
}

}  // namespace

void generate_rays(const RayKernelInputs& kernel, shadow::RayScratch& scratch) {
    with_light(kernel.lights, kernel.light, [&](const auto& light) {
        for (int y = 0; y < kTileSize; ++y)
            scratch.active[y] = generate_row(kernel, light, y, scratch);
    });
}

}  // namespace penumbra::PENUMBRA_ISA
