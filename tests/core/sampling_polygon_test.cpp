#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/math/frame.h"
#include "core/sampling/polygon.h"
#include "core/sampling/sequence.h"

namespace penumbra {
namespace {

Vec3d to_double(const Vec3f& v) {
    return {v.x, v.y, v.z};
}

Vec3f to_float(const Vec3d& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

struct Case {
    std::vector<Vec3f> vertices;
    Vec3f point, normal;
};

// A convex polygon with `count` corners on an ellipse around the world's origin, facing the point,
// which lies at distance 1: so that the vertices of tiny lights are exact.
Case random_case(std::mt19937& random, int count, double radius, double squash) {
    std::uniform_real_distribution<double> unit(0, 1);
    std::normal_distribution<double> gauss;
    const Vec3d axis = normalize(Vec3d{gauss(random), gauss(random), gauss(random)});
    const Vec3d towards =
        normalize(axis + Vec3d{gauss(random), gauss(random), gauss(random)} * 0.4);
    const Frame<double> frame = frame_from_normal(-towards);
    const double turn = 6.28 * unit(random);
    Case result;
    for (int i = 0; i < count; ++i) {
        const double angle = turn + 6.283185307179586 * (i + 0.6 * unit(random)) / count;
        result.vertices.push_back(to_float(frame.tangent * (radius * std::cos(angle)) +
                                           frame.bitangent * (radius * squash * std::sin(angle))));
    }
    result.point = to_float(-axis);
    result.normal =
        to_float(normalize(axis + Vec3d{gauss(random), gauss(random), gauss(random)} * 0.2));
    return result;
}

// Turns the horizon so that it cuts the light.
void put_on_horizon(Case& c) {
    const Vec3d axis =
        normalize((to_double(c.vertices[0]) + to_double(c.vertices[2])) * 0.5 - to_double(c.point));
    c.normal = to_float(normalize(cross(axis, to_double(c.normal) + Vec3d{0.3, 0.1, 0.7})));
}

// Independent of the code under test: Sutherland and Hodgman's clipping, and the solid angle as
// spherical excess from L'Huilier's formula, all in long double.
struct Long3 {
    long double x, y, z;
};
long double dot_long(const Long3& a, const Long3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

std::vector<Long3> clip_long(const Case& c) {
    const Long3 normal = {c.normal.x, c.normal.y, c.normal.z};
    std::vector<Long3> in, out;
    for (const Vec3f& v : c.vertices)
        in.push_back({static_cast<long double>(v.x) - c.point.x,
                      static_cast<long double>(v.y) - c.point.y,
                      static_cast<long double>(v.z) - c.point.z});
    for (std::size_t i = 0; i < in.size(); ++i) {
        const Long3 a = in[i], b = in[(i + 1) % in.size()];
        const long double ha = dot_long(normal, a), hb = dot_long(normal, b);
        if (ha >= 0) out.push_back(a);
        if ((ha < 0) != (hb < 0)) {
            const long double t = ha / (ha - hb);
            out.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)});
        }
    }
    return out;
}

long double angle_between(const Long3& a, const Long3& b) {
    const Long3 c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    return std::atan2(std::sqrt(dot_long(c, c)), dot_long(a, b));
}

long double triangle_excess(const Long3& a, const Long3& b, const Long3& c) {
    const long double p = angle_between(b, c), q = angle_between(c, a), r = angle_between(a, b);
    const long double s = (p + q + r) / 2;
    const long double product =
        std::tan(s / 2) * std::tan((s - p) / 2) * std::tan((s - q) / 2) * std::tan((s - r) / 2);
    return 4 * std::atan(std::sqrt(std::max(product, 0.0L)));
}

double expected_solid_angle(const Case& c) {
    const std::vector<Long3> part = clip_long(c);
    long double sum = 0;
    for (std::size_t i = 1; i + 1 < part.size(); ++i)
        sum += triangle_excess(part[0], part[i], part[i + 1]);
    return static_cast<double>(sum);
}

template <class F, class T>
double sampled_solid_angle(const Case& c) {
    std::vector<Vec3<T>> vertices;
    for (const Vec3f& v : c.vertices) vertices.push_back({T(v.x), T(v.y), T(v.z)});
    const auto shape = make_polygon_shape(vertices.data(), static_cast<int>(vertices.size()));
    const auto seen = see_polygon<F>(shape, {F(c.point.x), F(c.point.y), F(c.point.z)},
                                     {F(c.normal.x), F(c.normal.y), F(c.normal.z)});
    return static_cast<double>(make_polygon_sampler(shape, seen).solid_angle);
}

// The mean over the clipped polygon's directions of a smooth function of the direction, by
// subdivision of its triangles in the plane.
Vec3d mean_direction(const Case& c) {
    const std::vector<Long3> part = clip_long(c);
    constexpr int kSteps = 200;
    Vec3d sum{0, 0, 0};
    double total = 0;
    for (std::size_t i = 1; i + 1 < part.size(); ++i)
        for (int a = 0; a < kSteps; ++a)
            for (int b = 0; b < kSteps; ++b) {
                // Midpoints of a square folded to the triangle: u >= v.
                const double u = std::sqrt((a + 0.5) / kSteps), v = (b + 0.5) / kSteps;
                const auto at = [&](auto get) {
                    const double p = static_cast<double>(get(part[0]));
                    const double q = static_cast<double>(get(part[i]));
                    const double r = static_cast<double>(get(part[i + 1]));
                    return p + u * ((q - p) + v * (r - q));
                };
                const Vec3d place = {at([](const Long3& l) { return l.x; }),
                                     at([](const Long3& l) { return l.y; }),
                                     at([](const Long3& l) { return l.z; })};
                const Vec3d e1 = {static_cast<double>(part[i].x - part[0].x),
                                  static_cast<double>(part[i].y - part[0].y),
                                  static_cast<double>(part[i].z - part[0].z)};
                const Vec3d e2 = {static_cast<double>(part[i + 1].x - part[0].x),
                                  static_cast<double>(part[i + 1].y - part[0].y),
                                  static_cast<double>(part[i + 1].z - part[0].z)};
                const double distance = length(place);
                const double weight =
                    std::fabs(dot(cross(e1, e2), place)) / (distance * distance * distance);
                sum += place * (weight / distance);
                total += weight;
            }
    return sum / total;
}

std::vector<Case> all_kinds() {
    std::mt19937 random(7);
    std::vector<Case> cases;
    for (int round = 0; round < 6; ++round)
        for (const int count : {3, 4, 5, 8})
            for (const double radius : {1e-8, 1e-4, 0.02, 0.3, 2.0})
                for (const double squash : {1.0, 0.01}) {
                    Case c = random_case(random, count, radius, squash);
                    if (round % 3 == 2 && radius > 1e-6) put_on_horizon(c);
                    cases.push_back(c);
                }
    return cases;
}

}  // namespace

TEST_CASE("the sampled solid angle is that of the polygon above the horizon, in float and double") {
    int visible = 0;
    for (const Case& c : all_kinds()) {
        const double expected = expected_solid_angle(c);
        const double in_double = sampled_solid_angle<double, double>(c);
        if (in_double == 0) continue;
        ++visible;
        CHECK(in_double == doctest::Approx(expected).epsilon(1e-7));
        // Cut lights lose digits to the rounding of the vertices' heights.
        const double size = std::sqrt(expected);
        const double error = std::fabs(sampled_solid_angle<float, float>(c) - expected);
        INFO("solid angle " << expected << " vertices " << c.vertices.size());
        CHECK(error <= 1e-5 * expected + 3e-6 * size);
    }
    CHECK(visible > 150);
}

TEST_CASE("samples lie on the light, above the horizon, and are uniform in the solid angle" *
          doctest::test_suite("statistics")) {
    constexpr int kSide = 200;  // stratified: the error of a mean is far below 1 / samples^0.5
    for (const Case& c : all_kinds()) {
        const auto shape =
            make_polygon_shape(c.vertices.data(), static_cast<int>(c.vertices.size()));
        const auto seen = see_polygon<float>(shape, c.point, c.normal);
        const auto sampler = make_polygon_sampler(shape, seen);
        if (!(sampler.solid_angle > 0)) continue;
        Vec3d sum{0, 0, 0};
        double worst_outside = 0, lowest = 0;
        for (int i = 0; i < kSide * kSide; ++i) {
            const Vec2f random = {(static_cast<float>(i % kSide) + 0.5f) / kSide,
                                  (static_cast<float>(i / kSide) + 0.5f) / kSide};
            const Vec3f place = sample_polygon(shape, seen, sampler, random);
            for (int edge = 0; edge < shape.count; ++edge) {
                const Vec3d inward = cross(to_double(shape.normal), to_double(shape.edges[edge]));
                const Vec3d from = to_double(place) - to_double(shape.offsets[edge]);
                worst_outside =
                    std::max(worst_outside, -dot(inward, from) / (length(inward) * shape.radius));
            }
            const Vec3d direction = to_double(seen.vertices[0]) + to_double(place);
            lowest = std::min(lowest, dot(direction, to_double(c.normal)) / length(direction));
            sum += normalize(direction);
        }
        INFO("vertices " << shape.count << " radius " << shape.radius);
        CHECK(worst_outside < 1e-6);
        CHECK(lowest > -2e-7);
        // Relative to the light's angular size, so that small lights are held to the same measure.
        const Vec3d expected = mean_direction(c);
        const double error = length(sum / (kSide * kSide) - expected);
        CHECK(error < 3e-3 * std::min(1.0, static_cast<double>(shape.radius)) + 3e-8);
    }
}

TEST_CASE("a direction to a sample hits the light, one beside it misses") {
    std::mt19937 random(3);
    for (int round = 0; round < 200; ++round) {
        const Case c = random_case(random, 3 + round % 6, 0.5, 0.7);
        const auto shape =
            make_polygon_shape(c.vertices.data(), static_cast<int>(c.vertices.size()));
        const auto seen = see_polygon<float>(shape, c.point, c.normal);
        const auto sampler = make_polygon_sampler(shape, seen);
        if (!(sampler.solid_angle > 0)) continue;
        const Vec3f place = sample_polygon(shape, seen, sampler, {0.43f, 0.31f});
        const auto inside = intersect_polygon(shape, seen, normalize(seen.vertices[0] + place));
        CHECK(inside.hit);
        CHECK(length(inside.place - place) < 1e-5f * shape.radius + 1e-6f);
        const Vec3f from_center = place + shape.vertices[0] - shape.center;
        const Vec3f beyond = place + normalize(from_center) * (2.5f * shape.radius);
        CHECK_FALSE(intersect_polygon(shape, seen, normalize(seen.vertices[0] + beyond)).hit);
        CHECK_FALSE(intersect_polygon(shape, seen, -normalize(seen.vertices[0] + place)).hit);
    }
}

TEST_CASE("a light that nearly fills the sky is sampled evenly") {
    // Half-width over distance; samples stay uniform to 1e-3 up to 300.
    const Vec3f vertices[4] = {{-100, -100, 1}, {-100, 100, 1}, {100, 100, 1}, {100, -100, 1}};
    const auto shape = make_polygon_shape(vertices, 4);
    const auto seen = see_polygon<float>(shape, {0, 0, 0}, {0, 0, 1});
    const auto sampler = make_polygon_sampler(shape, seen);
    CHECK(sampler.solid_angle == doctest::Approx(6.2266206).epsilon(1e-5));
    double z = 0;
    constexpr int kSide = 256;
    for (int i = 0; i < kSide * kSide; ++i) {
        const Vec2f random = {(static_cast<float>(i % kSide) + 0.5f) / kSide,
                              (static_cast<float>(i / kSide) + 0.5f) / kSide};
        const Vec3f direction = seen.vertices[0] + sample_polygon(shape, seen, sampler, random);
        z += static_cast<double>(normalize(direction).z);
    }
    CHECK(z / (kSide * kSide) == doctest::Approx(0.5045).epsilon(1e-3));
}

}  // namespace penumbra
