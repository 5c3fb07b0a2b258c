#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "apps/tools/ltc_fit/grid.h"
#include "apps/tools/ltc_fit/measure.h"
#include "tests/core/ltc_table_lanes_kernel.h"

namespace penumbra::tests {
namespace {

using ltc_fit::LobeConfiguration;

float table_value(int roughness_node, int angle_node, int column) {
    return kLtcTable[(roughness_node * kLtcAngleNodes + angle_node) * kLtcRowFloats + column];
}

LtcEntry<float> entry_at(double roughness, double cos_view) {
    return ltc_lookup(static_cast<float>(roughness), static_cast<float>(cos_view));
}

LtcEntry<float> entry_at_node(int roughness_node, int angle_node) {
    return entry_at(ltc_fit::node_roughness(roughness_node), ltc_fit::node_cos_view(angle_node));
}

}  // namespace

TEST_CASE("the table's lookup gives the same bits for float, 8 and 16 lanes") {
    constexpr int kCount = 1 << 16;
    const std::vector<float> a = lane_test_values(kCount, 1, 11);
    std::vector<float> b = lane_test_values(kCount, kSpecialValueCount, 12);
    // Half of the elements lie inside the table.
    for (std::size_t i = 1; i < b.size(); i += 2) b[i] = std::fabs(b[i]) / 8;
    std::vector<std::uint32_t> expected(static_cast<std::size_t>(kCount) * kLtcLaneResults);
    for (int i = 0; i < kCount; ++i) {
        const auto k = static_cast<std::size_t>(i);
        emit_ltc_lookup(a[k], b[k], Emit<float>(expected.data() + i, kCount));
    }
    for_each_isa([&](simd::Isa isa) {
        std::vector<std::uint32_t> found(expected.size());
        simd::pick(isa, &avx2::ltc_lanes, &avx512::ltc_lanes)(a.data(), b.data(), found.data(),
                                                              kCount);
        CHECK(first_difference(expected, found, kCount) == "");
    });
}

TEST_CASE("the lookup returns the table's rows at its nodes and their mean between them") {
    for (const int row : {0, 7, 40, 63})
        for (const int column : {0, 1, 30, 62, 63}) {
            const LtcEntry<float> entry = entry_at_node(row, column);
            CHECK(entry.norm == doctest::Approx(table_value(row, column, 4)).epsilon(1e-4));
            CHECK(entry.m00 ==
                  doctest::Approx(table_value(row, column, 0) * table_value(row, column, 2))
                      .epsilon(1e-3));
        }
    const double between = 0.5 * (ltc_fit::node_roughness(30) + ltc_fit::node_roughness(31));
    const LtcEntry<float> entry = entry_at(between, ltc_fit::node_cos_view(20));
    CHECK(entry.norm ==
          doctest::Approx(0.5 * (table_value(30, 20, 4) + table_value(31, 20, 4))).epsilon(1e-5));
}

TEST_CASE(
    "roughness and cosine outside the table count as its nearest edge, NaN as the lower one") {
    CHECK(entry_at(0.0, 0.5).norm == entry_at(kMinimumRoughness, 0.5).norm);
    CHECK(entry_at(7.0, 0.5).norm == entry_at(1.0, 0.5).norm);
    CHECK(entry_at(0.5, -0.1).norm == entry_at(0.5, 0.0).norm);
    CHECK(entry_at(0.5, 1.0000001).norm == entry_at(0.5, 1.0).norm);
    CHECK(entry_at(std::nan(""), 0.5).norm == entry_at(kMinimumRoughness, 0.5).norm);
    CHECK(entry_at(0.5, std::nan("")).norm == entry_at(0.5, 0.0).norm);
}

TEST_CASE("the matrices of the table fit again to what is committed" *
          doctest::test_suite("statistics")) {
    for (const int row : {0, 9, 30, 55, 63})
        for (const int column : {1, 20, 45, 58}) {
            CAPTURE(row);
            CAPTURE(column);
            const LobeConfiguration lobe{ltc_fit::node_roughness(row),
                                         ltc_fit::node_cos_view(column)};
            // From the neighbour's shape, as the tool does, but not along the whole row.
            const ltc_fit::LtcShape start = ltc_fit::initial_shape(lobe);
            const ltc_fit::LtcShape stored =
                ltc_fit::shape_of_row(kLtcTable + (row * kLtcAngleNodes + column) * kLtcRowFloats);
            const ltc_fit::LtcShape fitted = ltc_fit::fit_shape(lobe, {start, stored});
            CHECK(fitted.tilt == doctest::Approx(stored.tilt).epsilon(1e-3));
            CHECK(fitted.stretch == doctest::Approx(stored.stretch).epsilon(1e-3));
            CHECK(fitted.lift == doctest::Approx(stored.lift).epsilon(1e-3));
        }
}

TEST_CASE("the amplitudes are the albedos, to 1e-5") {
    for (const int row : {0, 5, 21, 40, 63})
        for (const int column : {0, 12, 33, 50, 60, 63}) {
            CAPTURE(row);
            CAPTURE(column);
            const LobeConfiguration lobe{ltc_fit::node_roughness(row),
                                         ltc_fit::node_cos_view(column)};
            const ltc_fit::Albedo albedo = ltc_fit::integrate_albedo(lobe, 64, 700);
            CHECK(std::abs(table_value(row, column, 4) - albedo.norm) < 1e-5);
            CHECK(std::abs(table_value(row, column, 5) - albedo.fresnel) < 1e-5);
        }
}

TEST_CASE("the roughest lobe seen from above has the albedo 1 - ln 2") {
    const LtcEntry<float> entry = entry_at(1.0, 1.0);
    CHECK(std::abs(ltc_specular_albedo(entry, Vec3f{1, 1, 1}).x - (1 - std::numbers::ln2)) < 1e-5);
}

TEST_CASE("the distribution's horizon is the surface's: nothing leaks, nothing is lost") {
    for (const double roughness : {0.05, 0.31, 0.77})
        for (const double cos_view : {0.02, 0.3, 0.9}) {
            const LtcEntry<float> entry = entry_at(roughness, cos_view);
            CHECK(entry.m00 > 0);
            CHECK(entry.m22 > 0);
            for (const float azimuth : {0.0f, 1.0f, 3.0f, 5.0f}) {
                const Vec3f level{std::cos(azimuth), std::sin(azimuth), 0};
                CHECK(to_cosine_space(entry, level).z == 0);
                CHECK(from_cosine_space(entry, level).z == 0);
            }
        }
}

TEST_CASE("to_cosine_space, from_cosine_space and the density belong together") {
    for (const double roughness : {0.05, 0.4, 1.0})
        for (const double cos_view : {0.05, 0.5, 1.0}) {
            const LtcEntry<float> entry = entry_at(roughness, cos_view);
            const Vec3f back =
                normalize(from_cosine_space(entry, to_cosine_space(entry, {0.36f, 0.48f, 0.8f})));
            CHECK(back.x == doctest::Approx(0.36f).epsilon(1e-3));
            CHECK(back.y == doctest::Approx(0.48f).epsilon(1e-3));
            CHECK(entry.determinant() > 0);
            // Density where the distribution is 1/pi in cosine space: 1 / pi over the change of
            // solid angle of the map, by finite differences.
            const Vec3f top = normalize(from_cosine_space(entry, {0, 0, 1}));
            const float step = 1e-3f;
            const Vec3f along = normalize(from_cosine_space(entry, {step, 0, 1})) - top;
            const Vec3f across = normalize(from_cosine_space(entry, {0, step, 1})) - top;
            const double solid_angle = length(cross(along, across));
            CHECK(ltc_density(entry, top) * solid_angle * std::numbers::pi ==
                  doctest::Approx(step * step).epsilon(2e-2));
        }
}

TEST_CASE("neighbouring rows of the table are close to each other") {
    // Largest second differences over the table; a fit caught in another minimum shows as a jump of
    // the order of 1. At grazing the lobe itself turns within a few roughnesses.
    double along_angle = 0;
    double along_roughness = 0;
    double along_roughness_to_88_degrees = 0;
    for (int row = 1; row + 1 < kLtcRoughnessNodes; ++row)
        for (int angle = 1; angle + 1 < kLtcAngleNodes; ++angle)
            for (int column = 0; column < 6; ++column) {
                const float centre = 2 * table_value(row, angle, column);
                const double by_angle = std::abs(table_value(row, angle - 1, column) - centre +
                                                 table_value(row, angle + 1, column));
                const double by_roughness = std::abs(table_value(row - 1, angle, column) - centre +
                                                     table_value(row + 1, angle, column));
                along_angle = std::max(along_angle, by_angle);
                along_roughness = std::max(along_roughness, by_roughness);
                if (ltc_fit::node_cos_view(angle) > 0.035)
                    along_roughness_to_88_degrees =
                        std::max(along_roughness_to_88_degrees, by_roughness);
            }
    CHECK(along_angle < 0.1);
    CHECK(along_roughness < 0.35);
    CHECK(along_roughness_to_88_degrees < 0.15);
}

TEST_CASE("the table is as close to GGX as it must be, seen through the lookup" *
          doctest::test_suite("statistics")) {
    const ltc_fit::TableErrors errors = ltc_fit::table_errors(kLtcTable, 90, 0.01);
    CHECK(errors.albedo.count == 400);
    CHECK(errors.relative_l1.mean() <= 0.125);
    CHECK(errors.relative_l2.mean() <= 0.1);
    CHECK(errors.albedo.mean() <= 0.0005);
    CHECK(errors.albedo.maximum <= 0.005);
}

}  // namespace penumbra::tests
