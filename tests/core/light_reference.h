#pragma once

#include <functional>
#include <random>
#include <vector>

#include "core/math/vec.h"

// Light of a polygon by adaptive cubature over its area, in double: knows nothing of the closed
// forms it judges.

namespace penumbra::light_reference {

using Points = std::vector<Vec3d>;

// The part of a convex polygon where a function that is linear in the position is not negative.
inline Points clip(const Points& polygon, const std::function<double(const Vec3d&)>& height) {
    Points kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d& a = polygon[i];
        const Vec3d& b = polygon[(i + 1) % polygon.size()];
        const double height_a = height(a), height_b = height(b);
        if (height_a >= 0) kept.push_back(a);
        if ((height_a >= 0) != (height_b >= 0))
            kept.push_back(a + (b - a) * (height_a / (height_a - height_b)));
    }
    return kept;
}

using Integrand = std::function<double(const Vec3d&)>;

// Radon's rule of degree 5 on one triangle.
inline double triangle_rule(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Integrand& f) {
    const double root = std::sqrt(15.0);
    const double places[2] = {(6 - root) / 21, (6 + root) / 21};
    const double weights[2] = {(155 - root) / 1200, (155 + root) / 1200};
    double sum = 0.225 * f((a + b + c) / 3);
    for (int ring = 0; ring < 2; ++ring) {
        const double p = places[ring], q = 1 - 2 * p;
        sum += weights[ring] *
               (f(a * p + b * p + c * q) + f(a * p + b * q + c * p) + f(a * q + b * p + c * p));
    }
    return sum * length(cross(b - a, c - a)) / 2;
}

inline double integrate_triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Integrand& f,
                                 double whole, double tolerance, int depth) {
    const Vec3d ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
    const double parts[4] = {triangle_rule(a, ab, ca, f), triangle_rule(ab, b, bc, f),
                             triangle_rule(ca, bc, c, f), triangle_rule(ab, bc, ca, f)};
    const double sum = parts[0] + parts[1] + parts[2] + parts[3];
    if (depth == 0 || std::fabs(sum - whole) < tolerance) return sum;
    const double next = tolerance / 2;
    return integrate_triangle(a, ab, ca, f, parts[0], next, depth - 1) +
           integrate_triangle(ab, b, bc, f, parts[1], next, depth - 1) +
           integrate_triangle(ca, bc, c, f, parts[2], next, depth - 1) +
           integrate_triangle(ab, bc, ca, f, parts[3], next, depth - 1);
}

// Of f over the polygon's area; `precision` is relative.
inline double integrate(const Points& polygon, const Integrand& f, double precision = 1e-9) {
    double rough = 0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        rough += std::fabs(triangle_rule(polygon[0], polygon[i], polygon[i + 1], f));
    double sum = 0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum += integrate_triangle(polygon[0], polygon[i], polygon[i + 1], f,
                                  triangle_rule(polygon[0], polygon[i], polygon[i + 1], f),
                                  precision * rough, 12);
    return sum;
}

// 1/pi * the integral of n.w over the polygon's directions w above the horizon; both sides emit.
inline double lambert_form_factor(const Points& polygon, const Vec3d& point, const Vec3d& normal) {
    const Vec3d area = cross(polygon[1] - polygon[0], polygon[2] - polygon[0]);
    const Vec3d light_normal = normalize(area);
    const double distance = std::fabs(dot(light_normal, point - polygon[0]));
    const Points part = clip(polygon, [&](const Vec3d& p) { return dot(normal, p - point); });
    if (part.size() < 3) return 0;
    return integrate(part,
                     [&](const Vec3d& p) {
                         const Vec3d v = p - point;
                         const double squared = dot(v, v);
                         return dot(normal, v) * distance / (squared * squared);
                     }) /
           3.14159265358979323846;
}

// The integral of a density over directions, over the polygon's directions where two heights are
// not negative.
inline double density_over_polygon(const Points& polygon, const Vec3d& point,
                                   const std::function<double(const Vec3d&)>& density,
                                   const std::function<double(const Vec3d&)>& first_height,
                                   const std::function<double(const Vec3d&)>& second_height,
                                   double precision = 1e-8) {
    const Vec3d light_normal = normalize(cross(polygon[1] - polygon[0], polygon[2] - polygon[0]));
    const double distance = std::fabs(dot(light_normal, point - polygon[0]));
    Points part = clip(polygon, [&](const Vec3d& p) { return first_height(p - point); });
    part = clip(part, [&](const Vec3d& p) { return second_height(p - point); });
    if (part.size() < 3) return 0;
    return integrate(
        part,
        [&](const Vec3d& p) {
            const Vec3d v = p - point;
            const double r = length(v);
            return density(v / r) * distance / (r * r * r);
        },
        precision);
}

// ---- random lights -----------------------------------------------------------------------------

struct Configuration {
    Points polygon;
    Vec3d point, normal;      // the point's coordinates are floats
    double angular_size = 0;  // diameter over distance
};

class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double uniform(double low = 0, double high = 1) {
        return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
    }
    Vec3d direction() {
        const double z = uniform(-1, 1), angle = uniform(0, 6.28318530717958648);
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

  private:
    std::mt19937 engine_;
};

inline Vec3d rounded(const Vec3d& v) {
    // Through memory: at -O3 g++ 12 vectorises double -> float -> double to nothing.
    const volatile float x = static_cast<float>(v.x);
    const volatile float y = static_cast<float>(v.y);
    const volatile float z = static_cast<float>(v.z);
    return {x, y, z};
}

inline Points rounded(Points polygon) {
    for (Vec3d& vertex : polygon) vertex = rounded(vertex);
    return polygon;
}

// A convex polygon of 3 to 8 vertices on an ellipse of the given half-axes.
inline Points ellipse_polygon(Random& random, const Vec3d& center, const Vec3d& u, const Vec3d& v) {
    const int count = 3 + static_cast<int>(random.uniform(0, 5.999));
    const double phase = random.uniform(0, 6.28);
    Points polygon;
    for (int i = 0; i < count; ++i) {
        const double angle = phase + 6.28318530717958648 * (i + random.uniform(0, 0.6)) / count;
        polygon.push_back(center + u * std::cos(angle) + v * std::sin(angle));
    }
    return polygon;
}

// A light of about `size` radians at a random place, seen from a random point near the origin.
inline Configuration random_configuration(Random& random, double size, double needle = 1) {
    Configuration c;
    c.point = rounded(random.direction() * random.uniform(0, 2));
    c.normal = normalize(random.direction());
    const double distance = std::exp(random.uniform(-1.5, 1.5));
    const Vec3d u = random.direction();
    const Vec3d v = normalize(cross(u, random.direction()));
    const double half = size * distance / 2;
    c.polygon = ellipse_polygon(random, c.point + random.direction() * distance, u * half,
                                v * (half * needle));
    c.angular_size = size;
    return c;
}

}  // namespace penumbra::light_reference
