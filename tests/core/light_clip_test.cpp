#include <doctest/doctest.h>

#include "core/light/clip.h"
#include "tests/core/light_reference.h"

using namespace penumbra;
namespace reference = light_reference;

namespace {

bool same(const Vec3f& a, const Vec3f& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

Vec3d doubled_area(const Vec3d* vertices, int count) {
    Vec3d sum{0, 0, 0};
    for (int i = 0; i < count; ++i) sum += cross(vertices[i], vertices[(i + 1) % count]);
    return sum;
}

int distinct_edges(const ClippedPolygon<float>& polygon) {
    int edges = 0;
    for (int i = 0; i < polygon.count; ++i)
        if (!same(polygon.vertices[i], polygon.vertices[(i + 1) % polygon.count])) ++edges;
    return edges;
}

constexpr Vec3f kSquare[4] = {{1, -1, 2}, {1, 1, 2}, {-1, 1, 2}, {-1, -1, 2}};

}  // namespace

TEST_CASE("a polygon above the horizon is not touched by clipping") {
    const ClippedPolygon<float> clipped = clip_to_horizon(kSquare, 4);
    CHECK(clipped.visible);
    CHECK(clipped.count == 5);
    for (int i = 0; i < 4; ++i) CHECK(same(clipped.vertices[i], kSquare[i]));
    CHECK(same(clipped.vertices[4], kSquare[3]));
}

TEST_CASE("a polygon below the horizon disappears, also one that only touches it") {
    for (const float touching : {-1.0f, 0.0f}) {
        const Vec3f below[3] = {{0, 0, -2}, {1, 0, touching}, {0, 1, touching}};
        const ClippedPolygon<float> clipped = clip_to_horizon(below, 3);
        CHECK(!clipped.visible);
        for (int i = 0; i < clipped.count; ++i) CHECK(same(clipped.vertices[i], {0, 0, 0}));
    }
}

TEST_CASE("a polygon that stands on the horizon keeps its vertices exactly") {
    const Vec3f standing[3] = {{1, 3, 0}, {1, 0.3f, 0}, {1, 1, 5}};
    const ClippedPolygon<float> clipped = clip_to_horizon(standing, 3);
    CHECK(clipped.visible);
    for (int i = 0; i < 3; ++i) CHECK(same(clipped.vertices[i], standing[i]));
    const Vec3f hanging[4] = {{1, 1, 0}, {1, 2, 1}, {1, 3, 0}, {1, 2, -1}};
    const ClippedPolygon<float> cut = clip_to_horizon(hanging, 4);
    CHECK(distinct_edges(cut) == 3);
    CHECK(same(cut.vertices[0], hanging[0]));
    CHECK(same(cut.vertices[2], hanging[2]));
}

TEST_CASE("cut vertices lie on the horizon exactly, and edges through its vertices stay whole") {
    reference::Random random(3);
    for (int trial = 0; trial < 2000; ++trial) {
        const reference::Configuration c = reference::random_configuration(random, 2);
        Vec3f vertices[kMaxPolygonVertices];
        const int count = static_cast<int>(c.polygon.size());
        for (int i = 0; i < count; ++i) {
            const Vec3d v = c.polygon[static_cast<std::size_t>(i)] - c.point;
            vertices[i] = {static_cast<float>(v.x), static_cast<float>(v.y),
                           static_cast<float>(v.z)};
        }
        const ClippedPolygon<float> clipped = clip_to_horizon(vertices, count);
        for (int i = 0; i < clipped.count; ++i) {
            const Vec3f& v = clipped.vertices[i];
            bool original = false;
            for (int j = 0; j < count; ++j) original |= same(v, vertices[j]);
            CHECK((original ? v.z >= 0 : v.z == 0));
        }
        CHECK(distinct_edges(clipped) <= count + 1);
    }
}

TEST_CASE("clipping agrees with a second implementation for every way a polygon can be cut") {
    reference::Random random(4);
    double worst = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const reference::Configuration c = reference::random_configuration(random, 3);
        Vec3d vertices[kMaxPolygonVertices];
        const int count = static_cast<int>(c.polygon.size());
        reference::Points relative;
        for (int i = 0; i < count; ++i) {
            vertices[i] = c.polygon[static_cast<std::size_t>(i)] - c.point;
            relative.push_back(vertices[i]);
        }
        const ClippedPolygon<double> clipped = clip_to_horizon(vertices, count);
        const reference::Points expected =
            reference::clip(relative, [](const Vec3d& p) { return p.z; });
        const Vec3d area = doubled_area(clipped.vertices, clipped.count);
        const Vec3d expected_area =
            expected.empty() ? Vec3d{0, 0, 0}
                             : doubled_area(expected.data(), static_cast<int>(expected.size()));
        const double scale = length(doubled_area(vertices, count));
        worst = std::max(worst, length(area - expected_area) / scale);
    }
    CHECK(worst < 1e-12);
}
