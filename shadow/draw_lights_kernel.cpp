#include "shadow/draw_lights_kernel.h"

#include "core/frame/visibility.h"
#include "core/simd/kernel.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

// A light in the plane of a wall is seen and not swallowed by rounding: it may lie this much behind
// the surface, relative to the depth.
constexpr float kCoplanarBias = 0x1p-16f;

void put(PlaneView<float> plane, int x, int y, const M& where, const F& value) {
    if (!plane) return;
    float* to = plane.row(y) + x;
    simd::store(to, simd::select(where, value, simd::load<F>(to)));
}
void put(PlaneView<std::uint32_t> plane, int x, int y, const M& where, std::uint32_t value) {
    if (!plane) return;
    std::uint32_t* to = plane.row(y) + x;
    simd::store(to, simd::select(where, U(value), simd::load<U>(to)));
}
void put(const PlaneView3<float>& planes, int x, int y, const M& where, const Vec3<F>& value) {
    put(planes[0], x, y, where, value.x);
    put(planes[1], x, y, where, value.y);
    put(planes[2], x, y, where, value.z);
}

// What the pixels of a block show of the lights.
struct Shown {
    M seen = M(false);
    F depth;
    Vec3<F> radiance{F(0), F(0), F(0)};
    Vec3<F> normal{F(0), F(0), F(0)};
    Vec3<F> position{F(0), F(0), F(0)};         // world
    Vec3<F> position_before{F(0), F(0), F(0)};  // in the previous frame
};

template <class Shape>
void show(const shadow::Drawn<Shape>& light, const Camera& camera, const Vec3<F>& direction,
          Shown& shown) {
    const M inside = covers(light.outline, direction);
    if (!simd::any(inside)) return;
    const F depth = outline_depth(light.outline, direction);
    const M nearer =
        inside & (depth >= F(camera.near_distance)) & (depth * F(1 - kCoplanarBias) < shown.depth);
    const M wins = nearer & ((!shown.seen) | (depth < shown.depth));
    shown.depth = simd::select(wins, depth, shown.depth);
    shown.radiance = select(wins, broadcast<F>(light.emission.radiance), shown.radiance);
    shown.normal = select(wins, broadcast<F>(light.outline.normal), shown.normal);
    const Vec3<F> position = fma(direction, depth, broadcast<F>(camera.eye));
    shown.position = select(wins, position, shown.position);
    shown.position_before = select(wins, broadcast<F>(light.previous_from_current).point(position),
                                   shown.position_before);
    shown.seen |= wins;
}

void write(const shadow::DrawJob& job, int x, int y, const Shown& shown) {
    const SurfaceView& s = job.surface;
    const M m = shown.seen;
    const Vec3<F> zero{F(0), F(0), F(0)};
    put(s.position, x, y, m, shown.position);
    put(s.shadow_origin, x, y, m, shown.position);
    put(s.geometric_normal, x, y, m, shown.normal);
    put(s.normal, x, y, m, shown.normal);
    put(s.base_color, x, y, m, zero);
    put(s.roughness, x, y, m, F(0));
    put(s.metallic, x, y, m, F(0));
    put(s.dielectric_f0, x, y, m, F(0));
    put(s.emission, x, y, m, shown.radiance);
    put(s.depth, x, y, m, shown.depth);
    const Vec2<F> motion =
        pixel_motion(job.camera, shown.position, job.previous_camera, shown.position_before);
    put(s.motion_x, x, y, m, motion.x);
    put(s.motion_y, x, y, m, motion.y);
    put(s.instance, x, y, m, kNothing);
    put(s.triangle, x, y, m, kNothing);
    put(s.material, x, y, m, kNothing);
}

}  // namespace

void draw_lights_in_tile(const shadow::DrawJob& job) {
    for (int y = 0; y < kTileSize; ++y) {
        for (int x = 0; x < kTileSize; x += kLanes) {
            const F pixel_x = simd::to_float(simd::iota<I>() + I(job.x0 + x)) + F(0.5f);
            const F pixel_y = F(static_cast<float>(job.y0 + y) + 0.5f);
            const Vec3<F> direction = job.camera.direction(pixel_x, pixel_y);
            Shown shown;
            shown.depth = simd::load<F>(job.surface.depth.row(y) + x);
            for (int i = 0; i < job.lights.count; ++i)
                with_light(job.lights, static_cast<std::uint32_t>(i),
                           [&](const auto& light) { show(light, job.camera, direction, shown); });
            if (simd::any(shown.seen)) write(job, x, y, shown);
        }
    }
}

}  // namespace penumbra::PENUMBRA_ISA
