#include "core/compare/flip_kernel.h"

#include "core/compare/flip_formula.h"
#include "core/image/plane_lanes.h"
#include "core/simd/kernel.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

F clamp_to_unit(F x) {
    return simd::min(simd::max(x, F(0)), F(1));
}

// Filtered colours can leave the display's gamut: back to it before distances are taken.
Vec3<F> seen_colour(const compare::FlipFeatures& features, int x) {
    const Vec3<F> linear = compare::linear_from_ycxcz(load3<F>(features.colour, x));
    return compare::hunt_lab_from_linear(
        Vec3<F>{clamp_to_unit(linear.x), clamp_to_unit(linear.y), clamp_to_unit(linear.z)});
}

F magnitude(const float* const gradient[2], int x) {
    const F a = simd::load<F>(gradient[0] + x);
    const F b = simd::load<F>(gradient[1] + x);
    return simd::sqrt(simd::fma(a, a, b * b));
}

}  // namespace

void flip_opponent_row(const float* const linear[3], float* const ycxcz[3], int count) {
    for (int x = 0; x < count; x += kLanes) {
        const Vec3<F> c = compare::ycxcz_from_linear(load3<F>(linear, x));
        simd::store(ycxcz[0] + x, c.x);
        simd::store(ycxcz[1] + x, c.y);
        simd::store(ycxcz[2] + x, c.z);
    }
}

void flip_error_row(const compare::FlipFeatures& ref, const compare::FlipFeatures& test,
                    float largest_distance, float* errors, int count) {
    for (int x = 0; x < count; x += kLanes) {
        const F distance = compare::colour_distance(seen_colour(ref, x), seen_colour(test, x));
        const F colour_error = compare::redistribute(distance, largest_distance);
        const F edges = magnitude(ref.edge, x) - magnitude(test.edge, x);
        const F points = magnitude(ref.point, x) - magnitude(test.point, x);
        simd::store(errors + x, compare::flip_error(colour_error, edges, points));
    }
}

void flip_tone_row(const float* scene, float scale, float* display, int count) {
    for (int x = 0; x < count; x += kLanes)
        simd::store(display + x, compare::display_from_scene(simd::load<F>(scene + x) * F(scale)));
}

}  // namespace penumbra::PENUMBRA_ISA
