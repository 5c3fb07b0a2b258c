#include <doctest/doctest.h>

#include <array>

#include "apps/tools/ltc_fit/albedo.h"
#include "apps/tools/ltc_fit/measure.h"
#include "core/light/lobe_ratio.h"
#include "core/light/polygon.h"

// The glossy light of polygons against the true lobe.

namespace penumbra::tests {
namespace {

using ltc_fit::Albedo;
using ltc_fit::LightCase;
using ltc_fit::MeanAndMaximum;

constexpr std::array<double, 4> kF0{0.04, 0.2, 0.5, 1};

// Schlick's two terms of a light's radiance, by the closed form.
template <class T>
Albedo radiance_by_ratio(const LightCase& c, LobeAccuracy accuracy, double f0) {
    Vec3<T> vertices[kMaxPolygonVertices];
    for (std::size_t i = 0; i < c.light.size(); ++i)
        vertices[i] = {static_cast<T>(c.light[i].x), static_cast<T>(c.light[i].y),
                       static_cast<T>(c.light[i].z)};
    const PolygonShape<T> shape =
        make_polygon_shape(vertices, static_cast<int>(c.light.size()), true);
    const Vec3<T> normal{0, 0, 1};
    const SeenPolygon<T> seen = see_polygon(shape, Vec3<T>{0, 0, 0}, normal);
    if (!seen.lit) return {0, 0};
    const LtcEntry<float> e =
        ltc_lookup(static_cast<float>(c.lobe.roughness), static_cast<float>(c.lobe.cos_view));
    const LtcEntry<T> entry{e.m00, e.m02, e.m22, e.norm, e.fresnel};
    const TransformedLobe<T> fitted{
        {entry.m00, 0, entry.m02}, {0, 1, 0}, {0, 0, entry.m22}, entry.determinant()};
    const Vec3d view = c.lobe.view();
    const CosineSpaceLobe<T> exact = make_cosine_space_lobe(
        entry, static_cast<T>(c.lobe.alpha()),
        Vec3<T>{static_cast<T>(view.x), 0, static_cast<T>(view.z)}, static_cast<T>(f0));
    CosinePolygon<T> polygon;
    const FormFactors<T> factors = form_factors(shape, seen, normal, fitted, polygon);
    // Without a diffuse lobe: nothing hides what is wrong.
    const LobeIntegral<T> integral =
        integrate_lobe(exact, polygon, RatioDemand<T>{seen.lit, factors.ltc, T(0), accuracy});
    return {static_cast<double>(integral.plain), static_cast<double>(integral.fresnel)};
}

double with_fresnel(const Albedo& radiance, double f0) {
    return f0 * (radiance.norm - radiance.fresnel) + radiance.fresnel;
}

struct Errors {
    MeanAndMaximum radiance, error;
    [[nodiscard]] double relative() const { return error.mean() / radiance.mean(); }
};

std::array<Errors, kF0.size()> errors_of(const std::vector<LightCase>& lights,
                                         const std::vector<Albedo>& truths, LobeAccuracy accuracy) {
    std::array<Errors, kF0.size()> errors;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        for (std::size_t k = 0; k < kF0.size(); ++k) {
            const double expected = with_fresnel(truths[i], kF0[k]);
            const double found =
                with_fresnel(radiance_by_ratio<double>(lights[i], accuracy, kF0[k]), kF0[k]);
            errors[k].radiance.add(expected);
            errors[k].error.add(std::abs(found - expected));
        }
    }
    return errors;
}

// A square of the floor's mirror, moved along by `t` in [0, 1].
LightCase moving_square(double t, double roughness, double cos_view) {
    const double x = -3 + 2.5 * t;
    const double z = -0.4 + 1.0 * t;
    return {{roughness, cos_view},
            {{x, -0.5, z}, {x, 0.5, z}, {x + 0.2, 0.5, z + 1}, {x + 0.2, -0.5, z + 1}}};
}

}  // namespace

TEST_CASE("the glossy light of random polygons is that of the true lobe") {
    constexpr int kLights = 720;
    std::vector<LightCase> lights;
    std::vector<Albedo> truths;
    for (int i = 0; i < kLights; ++i) {
        lights.push_back(ltc_fit::random_light(i));
        truths.push_back(ltc_fit::radiance_by_cubature(lights.back(), 256));
    }
    const auto exact = errors_of(lights, truths, LobeAccuracy::kExact);
    const auto fast = errors_of(lights, truths, LobeAccuracy::kFast);
    for (std::size_t k = 0; k < kF0.size(); ++k) {
        CAPTURE(kF0[k]);
        MESSAGE("F0 " << kF0[k] << ": mean error " << exact[k].error.mean() << " ("
                      << 100 * exact[k].relative() << " % of the mean), fast "
                      << fast[k].error.mean());
        CHECK(exact[k].relative() <= 0.015);
        CHECK(exact[k].error.mean() <= 0.0011);
        CHECK(fast[k].relative() <= 0.10);
    }
}

TEST_CASE("a small light is the lobe at its direction times its solid angle") {
    for (const double roughness : {0.1, 0.4, 0.9})
        for (const double cos_view : {0.05, 0.4, 1.0})
            for (const double angle : {0.1, 0.8, 1.4}) {
                const Vec3d to_light = ltc_fit::direction_at(angle, 0.3);
                const Frame<double> frame = frame_from_normal(to_light);
                const double half = 1e-3;
                LightCase c{{roughness, cos_view}, {}};
                for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
                    c.light.push_back(frame.to_world({x * half, y * half, 1}));
                const GgxLobe<double> lobe = ggx_evaluate(c.lobe.alpha(), c.lobe.view(), to_light);
                const double expected = lobe.brdf_times_cosine * 4 * half * half;
                CAPTURE(roughness);
                CAPTURE(cos_view);
                CAPTURE(angle);
                for (const LobeAccuracy accuracy : {LobeAccuracy::kFast, LobeAccuracy::kExact}) {
                    const Albedo found = radiance_by_ratio<double>(c, accuracy, 1);
                    CHECK(found.norm == doctest::Approx(expected).epsilon(2e-3));
                    CHECK(found.fresnel ==
                          doctest::Approx(expected * lobe.fresnel_weight).epsilon(2e-3));
                }
            }
}

TEST_CASE("a light that fills the hemisphere gives the albedo to 2 %") {
    for (const double roughness : {0.05, 0.3, 0.8})
        for (const double cos_view : {0.1, 0.5, 1.0}) {
            const LightCase c{
                {roughness, cos_view},
                {{-1e4, -1e4, 0.1}, {1e4, -1e4, 0.1}, {1e4, 1e4, 0.1}, {-1e4, 1e4, 0.1}}};
            const Albedo albedo = ltc_fit::integrate_albedo(c.lobe, 48, 512);
            const Albedo found = radiance_by_ratio<double>(c, LobeAccuracy::kExact, 1);
            CAPTURE(roughness);
            CAPTURE(cos_view);
            CHECK(found.norm == doctest::Approx(albedo.norm).epsilon(0.02));
        }
}

// Levels are blended, and vertices that the horizon cuts off change the triangles without a step.
TEST_CASE("glossy light has no steps while a light rises over the horizon into the mirror") {
    constexpr int kSteps = 4000;
    for (const double roughness : {0.15, 0.4, 0.8})
        for (const double cos_view : {0.1, 0.4, 0.8}) {
            double largest = 0;
            double largest_kink = 0;
            double before = 0, before_that = 0;
            for (int i = 0; i <= kSteps; ++i) {
                const LightCase c =
                    moving_square(static_cast<double>(i) / kSteps, roughness, cos_view);
                const double now =
                    with_fresnel(radiance_by_ratio<double>(c, LobeAccuracy::kExact, 0.04), 0.04);
                if (i > 1)
                    largest_kink = std::max(largest_kink, std::abs(now - 2 * before + before_that));
                largest = std::max(largest, now);
                before_that = before;
                before = now;
            }
            CAPTURE(roughness);
            CAPTURE(cos_view);
            CHECK(largest > 0);
            CHECK(largest_kink < 0.002 * largest);
        }
}

TEST_CASE("in float glossy light keeps its digits") {
    for (int i = 0; i < 720; ++i) {
        const LightCase c = ltc_fit::random_light(i);
        const double expected =
            with_fresnel(radiance_by_ratio<double>(c, LobeAccuracy::kExact, 0.04), 0.04);
        const double found =
            with_fresnel(radiance_by_ratio<float>(c, LobeAccuracy::kExact, 0.04), 0.04);
        CAPTURE(i);
        CHECK(std::abs(found - expected) < 2e-4 * expected + 2e-5);
    }
}

TEST_CASE("in float the smallest and the thinnest lights in a narrow lobe are without noise") {
    for (const double half : {5e-6, 1e-3, 0.02})
        for (const double thinness : {1.0, 1e-3})
            for (int i = 0; i < 200; ++i) {
                const double angle = (70 + 0.09 * i) * std::numbers::pi / 180;
                const Frame<double> frame = frame_from_normal(ltc_fit::direction_at(angle, 0.05));
                LightCase c{{0.15, std::cos(80 * std::numbers::pi / 180)}, {}};
                for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
                    c.light.push_back(frame.to_world({x * half, y * half * thinness, 1}));
                const double expected = radiance_by_ratio<double>(c, LobeAccuracy::kExact, 1).norm;
                const double found = radiance_by_ratio<float>(c, LobeAccuracy::kExact, 1).norm;
                // Edge sums of thin lights round so (core/light/polygon.h).
                const double rounding = 4e-7 / (half * thinness);
                CAPTURE(half);
                CAPTURE(thinness);
                CAPTURE(i);
                if (rounding < 0.2)
                    CHECK(std::abs(found - expected) < (0.005 + rounding) * expected);
            }
}

}  // namespace penumbra::tests
