#include "raster/clip.h"

#include <doctest/doctest.h>

#include "tests/raster/scenes.h"

using namespace penumbra;
using namespace penumbra::raster;

TEST_CASE(
    "two triangles get the same points on the edge they share, whichever way they run along it") {
    Camera camera = testing::look_at({0, 0, 0}, {0, 0, -1}, 640, 480);
    camera.near_distance = 0.1f;
    std::mt19937 random(17);
    const auto between = [&](float low, float high) {
        return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24f;
    };
    int different = 0;
    for (int round = 0; round < 2000; ++round) {
        const auto point = [&](float near_z, float far_z) {
            const float x = between(-0.2f, 0.2f);
            const float y = between(-0.2f, 0.2f);
            return Vec3f{x, y, between(near_z, far_z)};
        };
        const Vec3f behind = point(-3, 0.05f), ahead = point(0.2f, 3);
        const Vec3f left = point(0.2f, 3), right = point(0.2f, 3);
        SnappedVertex a[kMaxClippedTriangleVertices], b[kMaxClippedTriangleVertices];
        const int count_a = clip_triangle(camera, {behind, ahead, left}, a);
        const int count_b = clip_triangle(camera, {ahead, behind, right}, b);
        REQUIRE(count_a == 4);
        REQUIRE(count_b == 4);
        int shared = 0;  // `ahead`, and the point where the edge crosses the near plane
        for (const SnappedVertex& p : {a[0], a[1], a[2], a[3]})
            for (const SnappedVertex& q : {b[0], b[1], b[2], b[3]}) shared += p == q;
        different += shared < 2;
    }
    CHECK(different == 0);
}
