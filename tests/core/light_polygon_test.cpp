#include <doctest/doctest.h>

#include <algorithm>

#include "core/light/polygon.h"
#include "tests/core/light_reference.h"

using namespace penumbra;
namespace reference = light_reference;

namespace {

constexpr double kPi = 3.14159265358979323846;

template <class T>
Vec3<T> convert(const Vec3d& v) {
    return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}

template <class T>
PolygonShape<T> shape_of(const reference::Points& points, bool two_sided = true) {
    Vec3<T> vertices[kMaxPolygonVertices];
    for (std::size_t i = 0; i < points.size(); ++i) vertices[i] = convert<T>(points[i]);
    return make_polygon_shape(vertices, static_cast<int>(points.size()), two_sided);
}

template <class T>
T lambert(const PolygonShape<T>& shape, const Vec3d& point, const Vec3d& normal) {
    const Vec3<T> n = convert<T>(normal);
    return lambert_form_factor(shape, see_polygon(shape, convert<T>(point), n), n);
}

// A unit normal whose coordinates are floats.
Vec3d float_normal(const Vec3d& n) {
    return reference::rounded(normalize(reference::rounded(n)));
}

struct Errors {
    std::vector<double> values;
    void add(double value) { values.push_back(value); }
    double quantile(double q) {
        std::sort(values.begin(), values.end());
        return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
    }
};

reference::Points rectangle(const Vec3d& center, const Vec3d& u, const Vec3d& v) {
    return {center - u - v, center + u - v, center + u + v, center - u + v};
}

}  // namespace

TEST_CASE("a rectangle over a corner of its own is Schroeder's textbook form factor") {
    // A differential patch under the corner of a parallel a x b rectangle at distance c: Howell, "A
    // Catalog of Radiation Heat Transfer Configuration Factors", B-3.
    for (const auto& [a, b, c] :
         {Vec3d{1, 1, 1}, Vec3d{2, 0.5, 1}, Vec3d{0.3, 3, 0.2}, Vec3d{8, 9, 0.5}}) {
        const double x = a / c, y = b / c;
        const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
        const double expected =
            (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * kPi);
        const reference::Points light = {{0, 0, c}, {0, b, c}, {a, b, c}, {a, 0, c}};
        CHECK(lambert(shape_of<double>(light), {0, 0, 0}, {0, 0, 1}) ==
              doctest::Approx(expected).epsilon(1e-13));
        CHECK(lambert(shape_of<float>(light), {0, 0, 0}, {0, 0, 1}) ==
              doctest::Approx(expected).epsilon(1e-6));
    }
}

TEST_CASE("a light that fills the hemisphere has form factor 1") {
    const reference::Points light = rectangle({0, 0, 0.1}, {1e4, 0, 0}, {0, 1e4, 0});
    CHECK(lambert(shape_of<float>(light), {0, 0, 0}, {0, 0, 1}) ==
          doctest::Approx(1).epsilon(3e-5));
    // Half of it where the point looks along the light.
    CHECK(lambert(shape_of<float>(light), {0, 0, 0}, {1, 0, 0}) ==
          doctest::Approx(0.5).epsilon(3e-5));
}

TEST_CASE(
    "a light behind its back, below the horizon, or in the point's plane gives exactly nothing") {
    const reference::Points up = rectangle({0, 0, 1}, {1, 0, 0}, {0, 1, 0});  // emits upwards
    CHECK(lambert(shape_of<float>(up, false), {0, 0, 0}, {0, 0, 1}) == 0);
    CHECK(lambert(shape_of<float>(up, true), {0, 0, 0}, {0, 0, 1}) > 0.1f);
    CHECK(lambert(shape_of<float>(up, true), {0, 0, 0}, {0, 0, -1}) == 0);
    CHECK(lambert(shape_of<float>(up, false), {0, 0, 2}, {0, 0, -1}) > 0.1f);
    CHECK(lambert(shape_of<float>(up, true), {0.2, 0.3, 1}, {0, 0, 1}) == 0);
    CHECK(lambert(shape_of<float>(up, true), {0.2, 0.3, 1}, {0, 0, -1}) == 0);
    CHECK(lambert(shape_of<float>(up, true), {5, 0, 1}, {-1, 0, 0}) == 0);
    CHECK(lambert(shape_of<float>(up, true), {1, 1, 1}, {0, 0, 1}) == 0);
}

TEST_CASE("points on a flat emitter do not light themselves, anywhere in the world") {
    reference::Random random(11);
    for (int trial = 0; trial < 3000; ++trial) {
        const Vec3d center = random.direction() * std::exp(random.uniform(-5, 8));
        const double size = length(center) * std::exp(random.uniform(-5, 1));
        const Vec3d u = random.direction();
        const reference::Points light = reference::rounded(reference::ellipse_polygon(
            random, center, u * size, normalize(cross(u, random.direction())) * size));
        const PolygonShape<float> shape = shape_of<float>(light);
        const double a = random.uniform(0, 0.4), b = random.uniform(0, 0.4);
        const Vec3d point = light[0] * (1 - a - b) + light[1] * a + light[2] * b;
        const Vec3d normal{shape.normal.x, shape.normal.y, shape.normal.z};
        const double sign = trial % 2 ? 1.0 : -1.0;
        CHECK(lambert(shape, point, normal * sign) == 0);
    }
}

TEST_CASE("in double the closed form is the cubature of its definition") {
    reference::Random random(5);
    for (const double size : {1e-5, 1e-3, 0.1, 0.5, 1.0, 2.0, 4.0}) {
        for (const double needle : {1.0, 0.02}) {
            Errors errors;
            for (int trial = 0; trial < 60; ++trial) {
                const reference::Configuration c =
                    reference::random_configuration(random, size, needle);
                const double expected =
                    reference::lambert_form_factor(c.polygon, c.point, c.normal);
                const double value = lambert(shape_of<double>(c.polygon), c.point, c.normal);
                // Lights that the horizon cuts to a sliver have no digits to compare relatively.
                errors.add(std::fabs(value - expected) / (expected + 1e-4 * size * size));
            }
            CAPTURE(size);
            CAPTURE(needle);
            CHECK(errors.quantile(1) < 2e-6);
            CHECK(errors.quantile(0.9) < 1e-7);
        }
    }
}

TEST_CASE("in float lights of every size keep their digits") {
    reference::Random random(6);
    for (const double size : {1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.06, 0.1, 0.3, 1.0, 3.0, 10.0}) {
        Errors relative, absolute;
        for (int trial = 0; trial < 3000; ++trial) {
            reference::Configuration c = reference::random_configuration(random, size);
            c.polygon = reference::rounded(c.polygon);
            const Vec3d normal = float_normal(c.normal);
            const PolygonShape<double> exact = shape_of<double>(c.polygon);
            const double expected = lambert(exact, c.point, normal);
            const double value = lambert(shape_of<float>(c.polygon), c.point, normal);
            // Close to the light's plane the form factor itself is that sensitive to the last place
            // of the positions.
            const double distance = see_polygon(exact, c.point, normal).distance;
            const double sensitivity = std::max(1.0, exact.radius / distance);
            absolute.add(std::fabs(value - expected) / (std::min(size, 1.0) * sensitivity));
            if (expected > 0) relative.add(std::fabs(value - expected) / expected);
        }
        CAPTURE(size);
        CHECK(absolute.quantile(1) < 3e-7);
        CHECK(relative.quantile(0.5) < 4e-6);
        CHECK(relative.quantile(0.97) < 2e-4);
    }
}

TEST_CASE("the rule for small lights and the edge sum meet where one takes over") {
    reference::Random random(8);
    for (int trial = 0; trial < 300; ++trial) {
        const Vec3d u = random.direction();
        const Vec3d v = normalize(cross(u, random.direction()));
        const double half =
            kSmallLight<float> * std::sqrt(1.5);  // of a square: rms = half sqrt(2/3)
        const Vec3d facing = normalize(cross(u, v));
        const Vec3d normal = float_normal(facing + random.direction() * 0.5);
        double values[2];
        for (int side = 0; side < 2; ++side) {
            const double distance = side == 0 ? 0.999 : 1.001;
            values[side] =
                distance * distance *
                lambert(shape_of<float>(rectangle(facing * distance, u * half, v * half)),
                        {0, 0, 0}, normal);
        }
        CHECK(values[0] == doctest::Approx(values[1]).epsilon(3e-5));
    }
}

TEST_CASE("the parts of a light add up to the whole") {
    reference::Random random(9);
    double worst = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Vec3d u = random.direction() * random.uniform(0.1, 2);
        const Vec3d v = normalize(cross(u, random.direction())) * random.uniform(0.1, 2);
        const Vec3d center = random.direction() * random.uniform(0.3, 4);
        if (std::fabs(dot(center, normalize(cross(u, v)))) < 0.1) continue;  // ill-conditioned
        const Vec3d normal = float_normal(random.direction());
        const double share = random.uniform(0.05, 0.95);
        const reference::Points whole = rectangle(center, u, v);
        const Vec3d low = whole[0] + (whole[1] - whole[0]) * share;
        const Vec3d high = whole[3] + (whole[2] - whole[3]) * share;
        const auto factor = [&](const reference::Points& p) {
            return static_cast<double>(lambert(shape_of<float>(p), {0, 0, 0}, normal));
        };
        const double sum =
            factor({whole[0], low, high, whole[3]}) + factor({low, whole[1], whole[2], high});
        worst = std::max(worst, std::fabs(sum - factor(whole)));
    }
    CHECK(worst < 2e-6);
}

TEST_CASE("millimetres and kilometres give the same form factors") {
    reference::Random random(10);
    for (int trial = 0; trial < 300; ++trial) {
        const reference::Configuration c =
            reference::random_configuration(random, random.uniform(0.001, 3));
        const Vec3d normal = float_normal(c.normal);
        const reference::Points light = reference::rounded(c.polygon);
        const float value = lambert(shape_of<float>(light), c.point, normal);
        for (const double scale : {0x1p-10, 0x1p10, 0x1p20}) {  // powers of two round alike
            reference::Points scaled = light;
            for (Vec3d& v : scaled) v *= scale;
            CHECK(lambert(shape_of<float>(scaled), c.point * scale, normal) ==
                  doctest::Approx(value).epsilon(1e-6));
        }
    }
}

// Beside a light, close to its plane: the farthest vertex is up to 2000 plane distances away.
TEST_CASE(
    "near the light's plane the error grows with the farthest vertex over the plane distance") {
    reference::Random random(28);
    Errors scaled;
    double worst = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        reference::Configuration c = reference::random_configuration(random, 1);
        c.polygon = reference::rounded(c.polygon);
        const PolygonShape<double> exact = shape_of<double>(c.polygon);
        const Vec3d along = normalize(cross(exact.normal, random.direction()));
        const double radius = exact.radius;
        const double height = radius * std::exp(random.uniform(-7, 0));
        c.point = reference::rounded(exact.center + along * (radius * random.uniform(0, 2)) -
                                     exact.normal * height);
        c.normal = float_normal(random.direction());
        const SeenPolygon<double> seen = see_polygon(exact, c.point, c.normal);
        if (!seen.lit) continue;
        double farthest = 0;
        for (int i = 0; i < exact.count; ++i)
            farthest = std::max(farthest, length(seen.vertices[i]));
        const double error = std::fabs(lambert(shape_of<float>(c.polygon), c.point, c.normal) -
                                       lambert(exact, c.point, c.normal));
        scaled.add(error / (1 + farthest / seen.distance));
        worst = std::max(worst, error);
    }
    MESSAGE("largest error " << worst << "; over 1 + farthest / distance: 99th percentile "
                             << scaled.quantile(0.99) << ", largest " << scaled.quantile(1));
    CHECK(scaled.quantile(1) < 8e-8);
}
