#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/scene/track.h"

// The shapes and the emission of the scene file's lights over time. A new kind of light is a track
// with these overloads, a line in LightShapeTrack, and a reader in core/scene/read_lights.cpp.

namespace penumbra {

struct RectTrack {
    Vec3Track center, half_axis_u, half_axis_v;  // world space; emits to the side of u x v
};

struct PolygonTrack {
    std::vector<Vec3Track> vertices;  // 3 to kMaxLightVertices, world space
};

using LightShapeTrack = std::variant<RectTrack, PolygonTrack>;

struct EmissionTrack {
    Vec3Track radiance;
};

// The polygon's vertices; those of a rect run counter-clockwise seen from u x v.
[[nodiscard]] std::vector<Vec3d> vertices_at(const RectTrack& track, double time);
[[nodiscard]] std::vector<Vec3d> vertices_at(const PolygonTrack& track, double time);

// What the scene file calls it.
[[nodiscard]] const char* kind_name(const LightShapeTrack& track);

// What is wrong with the shape at a time. Nothing, if nothing is.
[[nodiscard]] std::optional<std::string> shape_problem(const LightShapeTrack& track, double time);

}  // namespace penumbra
