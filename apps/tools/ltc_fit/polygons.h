#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>
#include <vector>

#include "apps/tools/ltc_fit/lobe.h"
#include "core/light/ltc_table.h"
#include "core/math/frame.h"

// Random polygon lights in the shading frame, and the plain ways to shade with them: cubature over
// the true lobe and the closed form over the table's distribution, both in double precision.

namespace penumbra::ltc_fit {

using Polygon = std::vector<Vec3d>;

// SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", 2014).
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    double next() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15ull;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
    double between(double low, double high) { return low + (high - low) * next(); }

  private:
    std::uint64_t state_;
};

struct LightCase {
    LobeConfiguration lobe;
    Polygon light;
};

// A unit vector at an angle to the normal, at an azimuth from the mirrored view.
inline Vec3d direction_at(double angle, double azimuth) {
    return {-std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
            std::cos(angle)};
}

// A convex, flat polygon inscribed in an ellipse, its centre at distance 1; leans as far as it can
// without reaching behind the point.
inline Polygon inscribed_polygon(const Vec3d& centre, int corners, const Vec2<double>& radii,
                                 Random& random) {
    const Frame<double> frame = frame_from_normal(centre);
    const double turn = random.between(0, 2 * std::numbers::pi);
    const double most = std::min(0.7, 0.55 / std::max(radii.x, radii.y));
    const double lean_u = random.between(-most, most);
    const double lean_v = random.between(-most, most);
    Polygon polygon;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * (i + random.between(0, 0.6)) / corners;
        const double along = radii.x * std::cos(angle);
        const double across = radii.y * std::sin(angle);
        const double u = along * std::cos(turn) - across * std::sin(turn);
        const double v = along * std::sin(turn) + across * std::cos(turn);
        polygon.push_back(frame.to_world({u, v, 1 + lean_u * u + lean_v * v}));
    }
    return polygon;
}

// Kinds are 4 forms (triangle, quadrilateral, strip, hexagon) at 6 places: small and large near the
// mirror direction, anywhere, across the horizon, large overhead, all around. Views go down to n.v
// = 0.017; every third lobe is narrow.
inline LightCase random_light(int number) {
    Random random(static_cast<std::uint64_t>(number));
    const double degree = std::numbers::pi / 180;
    const double roughness = random.between(0.05, number % 3 == 0 ? 0.3 : 1);
    const double view_angle = random.between(0, 89) * degree;
    const int form = number % 4;
    const int place = number / 4 % 6;
    const double off = random.between(-0.3, 0.3);
    const double azimuth = random.between(-std::numbers::pi, std::numbers::pi);
    const double angle = random.between(0, 85) * degree;
    const std::array<Vec3d, 6> centre{direction_at(view_angle + 0.3 * off, off),
                                      direction_at(view_angle + off, off),
                                      direction_at(angle, azimuth),
                                      direction_at(random.between(80, 100) * degree, 4 * off),
                                      direction_at(0.3 * angle, azimuth),
                                      direction_at(0.6 * angle, azimuth)};
    constexpr std::array<double, 6> kLargest{0.1, 0.8, 0.5, 0.5, 2.0, 30.0};
    const double radius = kLargest[static_cast<std::size_t>(place)] * random.between(0.2, 1);
    constexpr std::array<int, 4> kCorners{3, 4, 4, 6};
    const Vec2<double> radii{radius, form == 2 ? 0.1 * radius : radius};
    return {{roughness, std::cos(view_angle)},
            inscribed_polygon(centre[static_cast<std::size_t>(place)],
                              kCorners[static_cast<std::size_t>(form)], radii, random)};
}

// The part with z >= 0. Sutherland and Hodgman, "Reentrant Polygon Clipping" (1974).
inline Polygon clip_to_horizon(const Polygon& polygon) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d& a = polygon[i];
        const Vec3d& b = polygon[(i + 1) % polygon.size()];
        if (a.z >= 0) result.push_back(a);
        if ((a.z >= 0) == (b.z >= 0)) continue;
        Vec3d crossing = a + (b - a) * (a.z / (a.z - b.z));
        crossing.z = 0;
        result.push_back(crossing);
    }
    return result;
}

// Integral of the clamped cosine over pi over a polygon with z >= 0, whichever way it winds.
// Lambert's formula.
inline double form_factor(const Polygon& polygon) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d a = normalize(polygon[i]);
        const Vec3d b = normalize(polygon[(i + 1) % polygon.size()]);
        const Vec3d normal = cross(a, b);
        const double sine = length(normal);
        if (sine > 0) sum += std::atan2(sine, dot(a, b)) / sine * normal.z;
    }
    return std::abs(sum) / (2 * std::numbers::pi);
}

inline double radiance_by_table(const LtcEntry<float>& entry, const Polygon& light) {
    Polygon transformed;
    for (const Vec3d& vertex : clip_to_horizon(light))
        transformed.push_back(
            {entry.m00 * vertex.x + entry.m02 * vertex.z, vertex.y, entry.m22 * vertex.z});
    return entry.norm * form_factor(transformed);
}

inline bool is_inside(const Vec3d& direction, const std::vector<Vec3d>& edge_planes) {
    bool all_positive = true;
    bool all_negative = true;
    for (const Vec3d& plane : edge_planes) {
        const double side = dot(direction, plane);
        all_positive = all_positive && side >= 0;
        all_negative = all_negative && side <= 0;
    }
    return all_positive || all_negative;
}

// The glossy radiance at F = 1, and its part with Schlick's (1 - v.h)^5.
inline Albedo radiance_by_cubature(const LightCase& light_case, int resolution) {
    std::vector<Vec3d> edge_planes;
    const Polygon& light = light_case.light;
    for (std::size_t i = 0; i < light.size(); ++i)
        edge_planes.push_back(cross(light[i], light[(i + 1) % light.size()]));
    Vec3d plane = cross(light[1] - light[0], light[2] - light[0]);
    if (dot(plane, light[0]) < 0) plane = -plane;
    Albedo sum{0, 0};
    for (const LobePoint& point : lobe_points(light_case.lobe, resolution)) {
        for (const double side : {-1.0, 1.0}) {
            const Vec3d direction{point.direction.x, side * point.direction.y, point.direction.z};
            // A cone and its mirror image have the same edges.
            if (dot(direction, plane) <= 0 || !is_inside(direction, edge_planes)) continue;
            sum.norm += 0.5 * point.value * point.solid_angle;
            sum.fresnel += 0.5 * point.value * point.solid_angle * point.fresnel_weight;
        }
    }
    return sum;
}

}  // namespace penumbra::ltc_fit
