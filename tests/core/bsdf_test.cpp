#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "core/bsdf/ggx.h"
#include "core/math/frame.h"

namespace penumbra {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Vec3d direction_at(double degrees, double azimuth) {
    return {std::sin(degrees * kDegree) * std::cos(azimuth),
            std::sin(degrees * kDegree) * std::sin(azimuth), std::cos(degrees * kDegree)};
}

// Visits the sphere in coordinates around the mirrored view, in steps that grow with the distance
// from it so that narrow lobes are resolved, and says how much solid angle each direction stands
// for. Knows nothing of the sampler.
template <class Visit>
void integrate_sphere(const Vec3d& view, const Visit& visit) {
    constexpr int kPolar = 600;
    constexpr int kAzimuth = 240;
    const Frame<double> around = frame_from_normal(Vec3d{-view.x, -view.y, view.z});
    for (int i = 0; i < kPolar; ++i) {
        const double t = (i + 0.5) / kPolar;
        const double polar = std::numbers::pi * t * t * t;
        const double step = 3 * std::numbers::pi * t * t / kPolar;
        for (int j = 0; j < kAzimuth; ++j) {
            const double azimuth = 2 * std::numbers::pi * (j + 0.5) / kAzimuth;
            const Vec3d local{std::sin(polar) * std::cos(azimuth),
                              std::sin(polar) * std::sin(azimuth), std::cos(polar)};
            visit(around.to_world(local), std::sin(polar) * step * 2 * std::numbers::pi / kAzimuth);
        }
    }
}

double albedo(double alpha, const Vec3d& view) {
    double sum = 0;
    integrate_sphere(view, [&](const Vec3d& direction, double solid_angle) {
        sum += solid_angle * ggx_evaluate(alpha, view, direction).brdf_times_cosine;
    });
    return sum;
}

// Random directions on the sphere and random roughnesses for the tests below.
class RandomInputs {
  public:
    explicit RandomInputs(unsigned seed) : engine_(seed) {}
    float unit() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
    Vec3d direction() {
        const double z = unit();
        const double azimuth = 2 * std::numbers::pi * unit();
        const double radius = std::sqrt(1 - z * z);
        return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
    }
    // In float throughout: g++ 12 at -O2 merges a rounding to float and back into nothing.
    Vec3f float_direction() {
        const float x = unit() - 0.5f;
        const float y = unit() - 0.5f;
        const float z = unit();
        return normalize(Vec3f{x, y, z * z});
    }
    double alpha() {
        const double roughness = kMinimumRoughness + (1 - kMinimumRoughness) * unit();
        return roughness * roughness;
    }

  private:
    std::mt19937 engine_;
};

// What the sampler is judged by.
using Statistics = std::array<double, 8>;

Statistics statistics(const Vec3d& d) {
    return {d.x, d.y, d.z, d.x * d.x, d.y * d.y, d.x * d.y, d.y * d.z, d.z > 0.3 ? 1.0 : 0.0};
}

struct SampleMoments {
    Statistics mean{}, square{};
};

SampleMoments moments_by_density(double alpha, const Vec3d& view) {
    SampleMoments moments;
    integrate_sphere(view, [&](const Vec3d& direction, double solid_angle) {
        const double mass = solid_angle * ggx_evaluate(alpha, view, direction).density;
        const Statistics values = statistics(direction);
        for (std::size_t k = 0; k < values.size(); ++k) {
            moments.mean[k] += mass * values[k];
            moments.square[k] += mass * values[k] * values[k];
        }
    });
    return moments;
}

Statistics mean_of_samples(double alpha, const Vec3d& view, int count) {
    Statistics mean{};
    RandomInputs random(3);
    for (int i = 0; i < count; ++i) {
        const double u = random.unit();
        const double v = random.unit();
        const Statistics sample = statistics(ggx_sample_direction(alpha, view, {u, v}));
        for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += sample[k] / count;
    }
    return mean;
}

}  // namespace

TEST_CASE("the GGX BRDF is the same with view and light exchanged") {
    RandomInputs random(1);
    for (int i = 0; i < 10000; ++i) {
        const double alpha = random.alpha();
        const Vec3d view = random.direction();
        const Vec3d light = random.direction();
        const GgxLobe<double> forward = ggx_evaluate(alpha, view, light);
        const GgxLobe<double> backward = ggx_evaluate(alpha, light, view);
        CHECK(forward.brdf_times_cosine * view.z ==
              doctest::Approx(backward.brdf_times_cosine * light.z).epsilon(1e-9));
        CHECK(forward.fresnel_weight == doctest::Approx(backward.fresnel_weight));
    }
}

TEST_CASE("the GGX lobe is D F G2 / (4 n.v) as in the textbook") {
    RandomInputs random(2);
    for (int i = 0; i < 10000; ++i) {
        const double alpha = random.alpha();
        const Vec3d view = random.direction();
        const Vec3d light = random.direction();
        const Vec3d half = normalize(view + light);
        const auto lambda = [&](double cosine) {
            const double tangent2 = 1 / (cosine * cosine) - 1;
            return 0.5 * (std::sqrt(1 + alpha * alpha * tangent2) - 1);
        };
        const double slope = half.z * half.z * (alpha * alpha - 1) + 1;
        const double distribution = alpha * alpha / (std::numbers::pi * slope * slope);
        const double masking = 1 / (1 + lambda(view.z) + lambda(light.z));
        const GgxLobe<double> lobe = ggx_evaluate(alpha, view, light);
        CHECK(lobe.brdf_times_cosine ==
              doctest::Approx(distribution * masking / (4 * view.z)).epsilon(1e-6));
        CHECK(lobe.fresnel_weight == doctest::Approx(std::pow(1 - dot(view, half), 5)));
        CHECK(lobe.density ==
              doctest::Approx(distribution / (1 + lambda(view.z)) / (4 * view.z)).epsilon(1e-6));
    }
}

TEST_CASE("no surface reflects more than it receives") {
    for (const double roughness : {0.05, 0.2, 0.5, 1.0})
        for (const double degrees : {0.0, 45.0, 75.0, 85.0, 89.0}) {
            CAPTURE(roughness);
            CAPTURE(degrees);
            const double reflected = albedo(roughness * roughness, direction_at(degrees, 0.7));
            CHECK(reflected <= 1 + 1e-4);
            CHECK(reflected > 0.3);
        }
}

TEST_CASE("the albedo of the roughest surface seen from above is 1 - ln 2") {
    CHECK(albedo(1.0, {0, 0, 1}) == doctest::Approx(1 - std::numbers::ln2).epsilon(1e-5));
}

TEST_CASE("the density of mirrored visible normals integrates to 1") {
    for (const double roughness : {0.05, 0.2, 0.5, 1.0})
        for (const double degrees : {0.0, 45.0, 75.0, 85.0}) {
            CAPTURE(roughness);
            CAPTURE(degrees);
            const Vec3d view = direction_at(degrees, 2.1);
            double mass = 0;
            integrate_sphere(view, [&](const Vec3d& direction, double solid_angle) {
                mass += solid_angle * ggx_evaluate(roughness * roughness, view, direction).density;
            });
            CHECK(mass == doctest::Approx(1).epsilon(1e-3));
        }
}

TEST_CASE("mirrored visible normals fall as often as their density says") {
    // Eight statistics of the direction, in 12 configurations: their means over random samples
    // against integrals with the density, as z-scores. 4.6 sigma is 2e-6 per test, two-sided.
    constexpr int kSamples = 40000;
    for (const double roughness : {0.05, 0.3, 0.6, 1.0})
        for (const double degrees : {0.0, 40.0, 80.0}) {
            CAPTURE(roughness);
            CAPTURE(degrees);
            const double alpha = roughness * roughness;
            const Vec3d view = direction_at(degrees, 0.3);
            const SampleMoments expected = moments_by_density(alpha, view);
            const Statistics mean = mean_of_samples(alpha, view, kSamples);
            for (std::size_t k = 0; k < mean.size(); ++k) {
                CAPTURE(k);
                const double variance =
                    expected.square[k] - expected.mean[k] * expected.mean[k] + 1e-7;
                CHECK(std::abs(mean[k] - expected.mean[k]) <
                      4.6 * std::sqrt(variance / kSamples) + 2e-5);
            }
        }
}

TEST_CASE("a view along the surface loses no visible normal to the horizon") {
    RandomInputs random(4);
    for (int i = 0; i < 1000; ++i) {
        const float u = random.unit();
        const float v = random.unit();
        const Vec3f direction = ggx_sample_direction(0.25f, {1, 0, 0}, {u, v});
        CHECK(direction.z >= 0);
    }
}

TEST_CASE("float lobes agree with double ones to the last few digits, the narrowest ones too") {
    RandomInputs random(5);
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
        const float alpha = i % 2 == 0 ? 0.0025f : 0.0025f + random.unit();
        const Vec3f view = random.float_direction();
        const float across = random.unit();
        const float around = random.unit();
        const Vec3f light = ggx_sample_direction(alpha, view, {across, around});
        if (!(light.z > 0)) continue;
        const GgxLobe<float> lobe = ggx_evaluate(alpha, view, light);
        const GgxLobe<double> exact =
            ggx_evaluate<double>(alpha, {view.x, view.y, view.z}, {light.x, light.y, light.z});
        worst = std::max(worst, std::abs(lobe.brdf_times_cosine / exact.brdf_times_cosine - 1));
        worst = std::max(worst, std::abs(lobe.density / exact.density - 1));
    }
    CHECK(worst < 2e-6);
}

TEST_CASE("every result is finite at grazing and for opposite or equal directions") {
    const std::array<Vec3f, 7> directions{{{0, 0, 1},
                                           {1, 0, 0},
                                           {-1, 0, 0},
                                           {0, 1, 0},
                                           {0.8f, 0, -0.6f},
                                           {1, 0, 1e-30f},
                                           {-0.6f, 0, 0.8f}}};
    for (const float alpha : {0.0025f, 0.1f, 1.0f})
        for (const Vec3f& view : directions)
            for (const Vec3f& light : directions) {
                const GgxLobe<float> lobe = ggx_evaluate(alpha, view, light);
                CHECK(std::isfinite(lobe.brdf_times_cosine));
                CHECK(lobe.brdf_times_cosine >= 0);
                CHECK(std::isfinite(lobe.density));
                CHECK(lobe.density >= 0);
                CHECK(lobe.fresnel_weight >= 0);
                CHECK(lobe.fresnel_weight <= 1);
            }
    for (const float u : {0.0f, 0x1.fffffep-1f})
        for (const Vec3f& view : directions) {
            const Vec3f sample = ggx_sample_direction(0.0025f, view, {u, 0.5f});
            CHECK(length(sample) == doctest::Approx(1).epsilon(1e-5));
        }
}

TEST_CASE("a light below the horizon is not reflected") {
    const GgxLobe<float> lobe = ggx_evaluate(0.5f, Vec3f{0, 0.6f, 0.8f}, Vec3f{0, -0.8f, -0.6f});
    CHECK(lobe.brdf_times_cosine == 0);
    CHECK(lambert_times_cosine(Vec3f{1, 1, 1}, -0.5f).x == 0);
}

TEST_CASE("the material takes F0 from the index of refraction or from the base colour") {
    const Vec3f colour{0.9f, 0.5f, 0.1f};
    const Brdf<float> plastic = make_brdf(colour, 0.5f, 0.0f, 0.04f);
    const Brdf<float> gold = make_brdf(colour, 0.01f, 1.0f, 0.04f);
    CHECK(plastic.diffuse_albedo.y == 0.5f);
    CHECK(plastic.f0.y == 0.04f);
    CHECK(plastic.alpha == 0.25f);
    CHECK(gold.diffuse_albedo.y == 0);
    CHECK(gold.f0.y == 0.5f);
    CHECK(gold.alpha == kMinimumRoughness * kMinimumRoughness);
}

TEST_CASE("Schlick's Fresnel runs from F0 to 1") {
    GgxLobe<float> lobe{2, 0, 1};
    CHECK(ggx_specular_times_cosine(lobe, {0.04f, 0.5f, 1}).x == doctest::Approx(0.08f));
    lobe.fresnel_weight = 1;
    CHECK(ggx_specular_times_cosine(lobe, {0.04f, 0.5f, 1}).x == doctest::Approx(2));
}

}  // namespace penumbra
