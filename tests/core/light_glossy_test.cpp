#include <doctest/doctest.h>

#include <algorithm>

#include "core/light/ltc_table.h"
#include "core/light/polygon.h"
#include "core/math/frame.h"
#include "tests/core/light_reference.h"

using namespace penumbra;
namespace reference = light_reference;

namespace {

template <class T>
Vec3<T> convert(const Vec3d& v) {
    return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}

template <class T>
PolygonShape<T> shape_of(const reference::Points& points) {
    Vec3<T> vertices[kMaxPolygonVertices];
    for (std::size_t i = 0; i < points.size(); ++i) vertices[i] = convert<T>(points[i]);
    return make_polygon_shape(vertices, static_cast<int>(points.size()), true);
}

LtcEntry<double> in_double(const LtcEntry<float>& e) {
    return {e.m00, e.m02, e.m22, e.norm, e.fresnel};
}

template <class T>
TransformedLobe<T> lobe_of(const LtcEntry<T>& entry, const Frame<T>& frame) {
    return {fma(frame.tangent, entry.m00, frame.normal * entry.m02), frame.bitangent,
            frame.normal * entry.m22, entry.determinant()};
}

// One light, one surface point and its lobe.
struct GlossyCase {
    reference::Configuration configuration;
    Vec3d normal, view;
    double roughness;
    LtcEntry<float> entry;
};

GlossyCase random_case(reference::Random& random, double size, double least_roughness) {
    GlossyCase c;
    c.configuration = reference::random_configuration(random, size);
    c.normal = reference::rounded(normalize(reference::rounded(c.configuration.normal)));
    do {
        c.view = random.direction();
    } while (dot(c.view, c.normal) < 0.02);
    c.roughness = random.uniform(least_roughness, 1);
    c.entry =
        ltc_lookup(static_cast<float>(c.roughness), static_cast<float>(dot(c.view, c.normal)));
    return c;
}

template <class T>
T form_factor(const GlossyCase& c, const LtcEntry<T>& entry) {
    const PolygonShape<T> shape = shape_of<T>(c.configuration.polygon);
    const Vec3<T> normal = convert<T>(c.normal);
    const Frame<T> frame = frame_from_normal_and_view(normal, convert<T>(c.view));
    const SeenPolygon<T> seen = see_polygon(shape, convert<T>(c.configuration.point), normal);
    return ltc_form_factor(shape, seen, lobe_of(entry, frame));
}

double cubature(const GlossyCase& c) {
    const Frame<double> frame = frame_from_normal_and_view(c.normal, c.view);
    const LtcEntry<double> entry = in_double(c.entry);
    return reference::density_over_polygon(
        c.configuration.polygon, c.configuration.point,
        [&](const Vec3d& w) { return ltc_density(entry, frame.to_local(w)); },
        [&](const Vec3d& v) { return dot(v, frame.normal); }, [](const Vec3d&) { return 1.0; });
}

}  // namespace

TEST_CASE("the glossy form factor is the cubature of the tabulated density") {
    reference::Random random(21);
    for (const double size : {0.1, 1.0, 4.0}) {
        double worst = 0;
        for (int trial = 0; trial < 60; ++trial) {
            const GlossyCase c = random_case(random, size, 0.3);
            const double expected = cubature(c);
            worst = std::max(worst, std::fabs(form_factor(c, in_double(c.entry)) - expected));
        }
        CAPTURE(size);
        CHECK(worst < 1e-6);
    }
}

TEST_CASE("in float the glossy form factor keeps its digits for every size and roughness") {
    reference::Random random(22);
    for (const double size : {1e-5, 1e-3, 0.03, 0.3, 1.0, 3.0}) {
        std::vector<double> errors;
        double worst = 0;
        for (int trial = 0; trial < 3000; ++trial) {
            GlossyCase c = random_case(random, size, 0.05);
            c.configuration.polygon = reference::rounded(c.configuration.polygon);
            const double expected = form_factor(c, in_double(c.entry));
            const double error = std::fabs(form_factor(c, c.entry) - expected);
            // Rounding of positions moves a light within a lobe of width alpha, and more so close
            // to the light's plane.
            const PolygonShape<double> exact = shape_of<double>(c.configuration.polygon);
            const double distance = see_polygon(exact, c.configuration.point, c.normal).distance;
            const double sensitivity = std::max(1.0, exact.radius / distance);
            worst = std::max(worst, error * c.roughness * c.roughness / sensitivity);
            if (expected > 1e-6) errors.push_back(error / expected);
        }
        CAPTURE(size);
        CHECK(worst < 2e-6);
        if (errors.size() > 100) {
            std::sort(errors.begin(), errors.end());
            CHECK(errors[errors.size() / 2] < 1e-5);
        }
    }
}
