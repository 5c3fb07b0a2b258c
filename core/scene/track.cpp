#include "core/scene/track.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/math/portable.h"

namespace penumbra {
namespace {

double mix(double a, double b, double t) {
    return a + (b - a) * t;
}
float mix(float a, float b, double t) {
    return static_cast<float>(mix(double{a}, double{b}, t));
}
Vec3f mix(const Vec3f& a, const Vec3f& b, double t) {
    return {mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t)};
}
// Along the shorter arc. Shoemake, "Animating Rotation with Quaternion Curves" (1985).
glm::dquat between(const glm::dquat& a, const glm::dquat& b, double t) {
    constexpr double kNearlyParallel = 1 - 1e-12;  // there sines lose their digits, lines do not
    const double cosine = glm::dot(a, b);
    const double sign = cosine < 0 ? -1 : 1;
    const double angle = portable::acos(sign * cosine);
    const bool is_line = sign * cosine > kNearlyParallel;
    const double from = is_line ? 1 - t : portable::sin((1 - t) * angle);
    const double to = is_line ? t : portable::sin(t * angle);
    return glm::normalize(a * from + b * (sign * to));
}
glm::dquat mix(const glm::dquat& a, const glm::dquat& b, double t) {
    return between(a, b, t);
}

template <class T>
T interpolate(const Track<T>& track, double time) {
    PENUMBRA_ASSERT(!track.keys.empty(), "a track without keys");
    const auto next = std::upper_bound(track.keys.begin(), track.keys.end(), time,
                                       [](double t, const auto& key) { return t < key.time; });
    if (next == track.keys.begin()) return next->value;
    const auto previous = next - 1;
    // Exactly on a key the key's value, to the last bit.
    if (next == track.keys.end() || previous->time == time) return previous->value;
    return mix(previous->value, next->value,
               (time - previous->time) / (next->time - previous->time));
}

// Rotations by multiples of 90 degrees come out a rounding error away from 0 and 1; snapped, they
// keep axis-aligned planes exactly axis-aligned.
double without_noise(double x) {
    const double nearest = std::nearbyint(x);
    return std::fabs(x - nearest) < 1e-15 ? nearest + 0.0 : x;
}

Vec3f scaled_column(const glm::dvec3& column, float scale) {
    return {static_cast<float>(without_noise(column.x) * scale),
            static_cast<float>(without_noise(column.y) * scale),
            static_cast<float>(without_noise(column.z) * scale)};
}

}  // namespace

float evaluate(const FloatTrack& track, double time) {
    return interpolate(track, time);
}
Vec3f evaluate(const Vec3Track& track, double time) {
    return interpolate(track, time);
}
glm::dquat evaluate(const RotationTrack& track, double time) {
    return interpolate(track, time);
}

Affine3f evaluate(const TransformTrack& track, double time) {
    const glm::dmat3 rotation = glm::mat3_cast(evaluate(track.rotate, time));
    const Vec3f scale = evaluate(track.scale, time);
    return {.column_x = scaled_column(rotation[0], scale.x),
            .column_y = scaled_column(rotation[1], scale.y),
            .column_z = scaled_column(rotation[2], scale.z),
            .translation = evaluate(track.translate, time)};
}

glm::dquat rotation_from_degrees(const Vec3d& degrees) {
    const auto about = [](double angle, const glm::dvec3& axis) {
        const double half = angle * (std::numbers::pi / 360);
        return glm::dquat(portable::cos(half), axis * portable::sin(half));
    };
    return about(degrees.z, {0, 0, 1}) * about(degrees.y, {0, 1, 0}) * about(degrees.x, {1, 0, 0});
}

}  // namespace penumbra
