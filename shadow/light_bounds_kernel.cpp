#include "shadow/light_bounds_kernel.h"

#include "core/frame/visibility.h"
#include "core/image/plane_lanes.h"
#include "core/simd/kernel.h"
#include "shadow/light_kinds.h"
#include "shadow/shade_point.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

using shadow::BlockBounds;
using shadow::kBlocks;
using shadow::kBlockSize;

// Balls are made larger, and bounds wider, than exact arithmetic would need.
constexpr float kRelativeSlack = 1e-4f;
constexpr float kPositionSlack = 1e-6f;  // of the largest coordinate: rounding of positions
constexpr float kHuge = 1e30f;

struct Range3 {
    Vec3<F> low{F(kHuge), F(kHuge), F(kHuge)};
    Vec3<F> high{F(-kHuge), F(-kHuge), F(-kHuge)};

    void include(const Vec3<F>& v, const M& where) {
        low = select(where,
                     Vec3<F>{simd::min(v.x, low.x), simd::min(v.y, low.y), simd::min(v.z, low.z)},
                     low);
        high = select(
            where, Vec3<F>{simd::max(v.x, high.x), simd::max(v.y, high.y), simd::max(v.z, high.z)},
            high);
    }
};

// Minima and maxima do not depend on the order, hence not on the number of lanes.
float lowest(const F& v) {
    alignas(64) float lanes[kLanes];
    simd::store(lanes, v);
    float low = lanes[0];
    for (int i = 1; i < kLanes; ++i) low = simd::min(lanes[i], low);
    return low;
}
float highest(const F& v) {
    return -lowest(-v);
}

// The glossy U of a light is a mean over points of the light: within a few per cent of what it
// bounds here.
constexpr float kGlossySlack = 1.05f;

// The most of the specular lobe, per steradian, without Fresnel: the distribution is at most
// 1 / (pi alpha^2), and cosine over masking grows with the cosine (core/bsdf/ggx.h).
F lobe_peak(const F& alpha, const F& cos_view) {
    return F(0.5f * static_cast<float>(kOneOverPi)) /
           (alpha * alpha * (ggx_smith_root(alpha, cos_view) + cos_view));
}

struct Ranges {
    Range3 position, normal, albedo, specular, f0;
    F peak = F(0);
    M any_hit = M(false);
};

void include_pixels(const shadow::BoundsJob& job, int x, int y, Ranges& ranges) {
    const ConstSurfaceView& surface = job.surface;
    const M hit = simd::load<U>(surface.material.row(y) + x) != U(kNothing);
    if (!simd::any(hit)) return;
    const Vec3<F> position = load3<F>(surface.position, x, y);
    const Vec3<F> normal = load3<F>(surface.normal, x, y);
    const Vec3<F> to_eye = broadcast<F>(job.eye) - position;
    const F inverse = F(1) / simd::sqrt(simd::max(length_squared(to_eye), F(1e-36f)));
    const F roughness = simd::load<F>(surface.roughness.row(y) + x);
    const F cos_view = simd::saturate(dot(normal, to_eye * inverse));
    const LtcEntry<F> entry = ltc_lookup(roughness, cos_view);
    const Brdf<F> brdf = make_brdf(load3<F>(surface.base_color, x, y), roughness,
                                   simd::load<F>(surface.metallic.row(y) + x),
                                   simd::load<F>(surface.dielectric_f0.row(y) + x));
    ranges.position.include(position, hit);
    ranges.normal.include(normal, hit);
    ranges.albedo.include(brdf.diffuse_albedo, hit);
    ranges.specular.include(ltc_specular_albedo(entry, brdf.f0) * F(kGlossySlack), hit);
    ranges.f0.include(brdf.f0, hit);
    ranges.peak = simd::max(
        simd::select(hit, lobe_peak(brdf.alpha, cos_view) * F(kGlossySlack), F(0)), ranges.peak);
    ranges.any_hit |= hit;
}

// Center and half diagonal of a box.
float ball(const Range3& range, int block, float (&center)[3][kBlocks]) {
    const float low[3] = {lowest(range.low.x), lowest(range.low.y), lowest(range.low.z)};
    const float high[3] = {highest(range.high.x), highest(range.high.y), highest(range.high.z)};
    float squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const float half = 0.5f * (high[axis] - low[axis]);
        center[axis][block] = 0.5f * (high[axis] + low[axis]);
        squared = simd::fma(half, half, squared);
    }
    return simd::sqrt(squared);
}

void high3(const Vec3<F>& v, int block, float (&to)[3][kBlocks]) {
    to[0][block] = highest(v.x);
    to[1][block] = highest(v.y);
    to[2][block] = highest(v.z);
}

void bound_block(const shadow::BoundsJob& job, int block, BlockBounds& bounds) {
    const int x0 = block % shadow::kBlocksPerRow * kBlockSize;
    const int y0 = block / shadow::kBlocksPerRow * kBlockSize;
    Ranges ranges;
    for (int y = y0; y < y0 + kBlockSize; ++y)
        for (int x = x0; x < x0 + kBlockSize; x += kLanes) include_pixels(job, x, y, ranges);
    const float radius = ball(ranges.position, block, bounds.center);
    const float largest =
        simd::max(simd::max(simd::abs(bounds.center[0][block]), simd::abs(bounds.center[1][block])),
                  simd::abs(bounds.center[2][block]));
    bounds.radius[block] =
        simd::any(ranges.any_hit)
            ? simd::fma(radius, 1 + kRelativeSlack, kPositionSlack * (largest + radius))
            : -1.0f;
    bounds.normal_radius[block] =
        ball(ranges.normal, block, bounds.normal_center) * (1 + kRelativeSlack) + kPositionSlack;
    bounds.albedo_low[0][block] = lowest(ranges.albedo.low.x);
    bounds.albedo_low[1][block] = lowest(ranges.albedo.low.y);
    bounds.albedo_low[2][block] = lowest(ranges.albedo.low.z);
    high3(ranges.albedo.high, block, bounds.albedo_high);
    high3(ranges.specular.high, block, bounds.specular);
    high3(ranges.f0.high, block, bounds.f0);
    bounds.peak[block] = highest(ranges.peak);
}

Vec3<F> load_blocks(const float (&from)[3][kBlocks], int block) {
    return {simd::load<F>(from[0] + block), simd::load<F>(from[1] + block),
            simd::load<F>(from[2] + block)};
}

Vec3<F> min3(const Vec3<F>& a, const Vec3<F>& b) {
    return {simd::min(a.x, b.x), simd::min(a.y, b.y), simd::min(a.z, b.z)};
}

// The most of Schlick's (1 - v.h)^5 between the eye and a light, each seen from the ball as a cone:
// v.h is the cosine of half the angle between them.
template <class Shape>
F largest_fresnel_weight(const shadow::SurfaceBall<F>& ball, const Vec3f& eye, const Shape& light) {
    const Vec3<F> to_eye = broadcast<F>(eye) - ball.center;
    const Vec3<F> to_light = broadcast<F>(light.center) - ball.center;
    const F eye_distance = simd::max(length(to_eye), F(1e-18f));
    const F light_distance = simd::max(length(to_light), F(1e-18f));
    const F cosine = dot(to_eye, to_light) / (eye_distance * light_distance);
    const F half_cosine = simd::sqrt(simd::saturate(simd::fma(F(0.5f), cosine, F(0.5f))));
    // Half the cones' sines, each at most pi / 2 of the half angle's radians; cosines change no
    // faster than angles.
    const F sines = ball.radius / eye_distance + (ball.radius + F(light.radius)) / light_distance;
    const F least = half_cosine - F(0.25f * 3.1415927f) * sines;
    return schlick_weight(simd::saturate(least));
}

// One light over as many blocks as there are lanes.
template <class Shape>
void bound_light(const Lit<Shape>& light, const Vec3f& eye, const BlockBounds& bounds, int block,
                 float* upper, float* lower) {
    const F radius = simd::load<F>(bounds.radius + block);
    const M used = radius >= F(0);
    const shadow::SurfaceBall<F> ball{load_blocks(bounds.center, block), radius,
                                      load_blocks(bounds.normal_center, block),
                                      simd::load<F>(bounds.normal_radius + block)};
    const auto form = bound_form_factor(ball, light.shape);
    const Vec3<F> radiance = broadcast<F>(light.emission.radiance);
    const F weight = largest_fresnel_weight(ball, eye, light.shape);
    const Vec3<F> fresnel =
        fma(load_blocks(bounds.f0, block), F(1) - weight, Vec3<F>{weight, weight, weight});
    const Vec3<F> glossy =
        min3(load_blocks(bounds.specular, block),
             fresnel * (simd::load<F>(bounds.peak + block) * form.solid_angle_high));
    const Vec3<F> high = fma(load_blocks(bounds.albedo_high, block), form.lambert_high, glossy);
    const Vec3<F> low = load_blocks(bounds.albedo_low, block) * form.lambert_low;
    simd::store(upper + block,
                simd::select(used, luminance(high * radiance) * F(1 + kRelativeSlack), F(0)));
    simd::store(lower + block,
                simd::select(used, luminance(low * radiance) * F(1 - kRelativeSlack), F(0)));
}

}  // namespace

void bound_lights(const shadow::BoundsJob& job) {
    BlockBounds bounds;
    for (int block = 0; block < kBlocks; ++block) bound_block(job, block, bounds);
    for (int i = 0; i < job.lights.count; ++i)
        with_light(job.lights, static_cast<std::uint32_t>(i), [&](const auto& light) {
            for (int block = 0; block < kBlocks; block += kLanes)
                bound_light(light, job.eye, bounds, block, job.upper + i * kBlocks,
                            job.lower + i * kBlocks);
        });
}

}  // namespace penumbra::PENUMBRA_ISA
