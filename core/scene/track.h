#pragma once

#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "core/math/affine.h"

// Animation tracks: values at times in seconds, interpolated linearly between keys and constant
// before the first and after the last. A track of one key does not move.

namespace penumbra {

template <class T>
struct Track {
    struct Key {
        double time;  // seconds, strictly increasing
        T value;
    };
    std::vector<Key> keys;  // at least one

    [[nodiscard]] bool moves() const { return keys.size() > 1; }
};

using FloatTrack = Track<float>;
using Vec3Track = Track<Vec3f>;
using RotationTrack = Track<glm::dquat>;  // neighbouring keys less than 180 degrees apart

[[nodiscard]] float evaluate(const FloatTrack& track, double time);
[[nodiscard]] Vec3f evaluate(const Vec3Track& track, double time);
[[nodiscard]] glm::dquat evaluate(const RotationTrack& track,
                                  double time);  // spherical, shortest arc

// T * R * S.
struct TransformTrack {
    Vec3Track translate, scale;
    RotationTrack rotate;

    [[nodiscard]] bool moves() const {
        return translate.moves() || scale.moves() || rotate.moves();
    }
};
[[nodiscard]] Affine3f evaluate(const TransformTrack& track, double time);

// Degrees about x, then y, then z.
[[nodiscard]] glm::dquat rotation_from_degrees(const Vec3d& degrees);

}  // namespace penumbra
