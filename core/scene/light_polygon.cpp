#include "core/scene/light_polygon.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/math/portable.h"

namespace penumbra {
namespace {

// A vertex may be this far off the plane, and a corner this far from convex, in units of the
// polygon's extent: what six printed digits leave of a planar polygon.
constexpr double kPlanarTolerance = 1e-4;
// Below this ratio of area to squared extent a polygon is a line.
constexpr double kSmallestAspect = 1e-9;

double extent_of(std::span<const Vec3d> vertices) {
    double extent = 0;
    for (const Vec3d& v : vertices) extent = std::max(extent, length(v - vertices[0]));
    return extent;
}

}  // namespace

Vec3d newell_normal(std::span<const Vec3d> vertices) {
    Vec3d sum{0, 0, 0};
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i)
        sum += cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]);
    return sum;
}

std::optional<std::string> polygon_problem(std::span<const Vec3d> vertices) {
    const double extent = extent_of(vertices);
    const Vec3d doubled_area = newell_normal(vertices);
    const double size = length(doubled_area);
    if (!(size > kSmallestAspect * extent * extent)) return "the light has no area";
    const Vec3d normal = doubled_area / size;
    double turned = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::size_t count = vertices.size();
        const Vec3d& here = vertices[i];
        if (std::fabs(dot(here - vertices[0], normal)) > kPlanarTolerance * extent)
            return fmt::format("vertex {} is off the plane of the others", i);
        const Vec3d in = here - vertices[(i + count - 1) % count];
        const Vec3d out = vertices[(i + 1) % count] - here;
        if (!(length(out) > 0))
            return fmt::format("vertices {} and {} coincide", i, (i + 1) % count);
        const double turn = dot(cross(in, out), normal);
        if (turn < -kPlanarTolerance * extent * std::max(length(in), length(out)))
            return fmt::format("the polygon is not convex at vertex {}", i);
        turned += portable::atan2(turn, dot(in, out));
    }
    // A star turns left at every corner too, but more than once around.
    if (turned > 7) return "the polygon crosses itself";
    return std::nullopt;
}

}  // namespace penumbra
