#include "core/scene/light_track.h"

#include "core/math/widen.h"
#include "core/scene/light_polygon.h"

namespace penumbra {
namespace {

const char* name_of(const RectTrack&) {
    return "rect";
}
const char* name_of(const PolygonTrack&) {
    return "polygon";
}

template <class Track>
std::optional<std::string> problem_of(const Track& track, double time) {
    return polygon_problem(vertices_at(track, time));
}

}  // namespace

std::vector<Vec3d> vertices_at(const RectTrack& track, double time) {
    const Vec3d center = widen(evaluate(track.center, time));
    const Vec3d u = widen(evaluate(track.half_axis_u, time));
    const Vec3d v = widen(evaluate(track.half_axis_v, time));
    return {center - u - v, center + u - v, center + u + v, center - u + v};
}

std::vector<Vec3d> vertices_at(const PolygonTrack& track, double time) {
    std::vector<Vec3d> vertices;
    vertices.reserve(track.vertices.size());
    for (const Vec3Track& vertex : track.vertices)
        vertices.push_back(widen(evaluate(vertex, time)));
    return vertices;
}

const char* kind_name(const LightShapeTrack& track) {
    return std::visit([](const auto& shape) { return name_of(shape); }, track);
}

std::optional<std::string> shape_problem(const LightShapeTrack& track, double time) {
    return std::visit([&](const auto& shape) { return problem_of(shape, time); }, track);
}

}  // namespace penumbra
