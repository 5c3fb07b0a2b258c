#include "core/scene/track.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/core/scene_testing.h"

using namespace penumbra;
using penumbra::testing::read_with;

namespace {

double degrees(double x) {
    return x * std::numbers::pi / 180;
}

TransformTrack still() {
    return {{{{0, {0, 0, 0}}}}, {{{0, {1, 1, 1}}}}, {{{0, rotation_from_degrees({0, 0, 0})}}}};
}

void check_near(const Vec3f& v, double x, double y, double z, double tolerance = 1e-6) {
    CHECK(std::fabs(v.x - x) <= tolerance);
    CHECK(std::fabs(v.y - y) <= tolerance);
    CHECK(std::fabs(v.z - z) <= tolerance);
}

const TransformTrack& transform_of(const Scene& scene) {
    return scene.models[0].transform;
}

Scene with_model(std::string_view fields) {
    return read_scene_text(fmt::format(R"({{"models": [{{"file": "triangle.obj", {}}}]}})", fields),
                           {{"triangle.obj", std::string(penumbra::testing::kTriangleObj)}});
}

}  // namespace

TEST_CASE("tracks are linear between keys and constant outside") {
    const FloatTrack track{{{1, 10}, {3, 20}, {4, 0}}};
    CHECK(evaluate(track, -5) == 10);
    CHECK(evaluate(track, 1) == 10);
    CHECK(evaluate(track, 1.5) == 12.5f);
    CHECK(evaluate(track, 3) == 20);
    CHECK(evaluate(track, 3.75) == 5);
    CHECK(evaluate(track, 99) == 0);
    check_near(evaluate(Vec3Track{{{0, {0, 0, 0}}, {2, {1, 2, -4}}}}, 0.5), 0.25, 0.5, -1);
}

TEST_CASE("a rotation between two keys turns at constant speed about one axis") {
    const glm::dquat from = rotation_from_degrees({0, 20, 0});
    const glm::dquat to = rotation_from_degrees({0, 140, 0});
    const RotationTrack track{{{0, from}, {3, to}}};
    for (const double t : {0.0, 0.3, 1.0, 2.2, 3.0}) {
        const double angle = degrees(20 + 40 * t) / 2;
        const glm::dquat q = evaluate(track, t);
        CHECK(q.w == doctest::Approx(std::cos(angle)).epsilon(1e-12));
        CHECK(q.y == doctest::Approx(std::sin(angle)).epsilon(1e-12));
        CHECK(std::fabs(q.x) + std::fabs(q.z) < 1e-15);
    }
}

TEST_CASE("rotations take the shorter arc, whatever the quaternions' signs") {
    const glm::dquat from = rotation_from_degrees({0, 0, 170});
    const glm::dquat to = -rotation_from_degrees({0, 0, 190});
    const glm::dquat middle = evaluate(RotationTrack{{{0, from}, {1, to}}}, 0.5);
    CHECK(std::fabs(middle.z) == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("a transform scales, then turns about x, y and z, then moves") {
    TransformTrack track = still();
    track.scale.keys[0].value = {2, 3, 4};
    track.rotate.keys[0].value = rotation_from_degrees({90, 0, 90});
    track.translate.keys[0].value = {10, 20, 30};
    const Affine3f a = evaluate(track, 0);
    // x axis: scaled by 2, unmoved by x, turned to y by z. y axis: to z by x. z axis: to -y, then
    // to x.
    CHECK(a.column_x.y == 2);
    CHECK(a.column_y.z == 3);
    CHECK(a.column_z.x == 4);
    CHECK(a.translation.x == 10);
    CHECK(a.translation.z == 30);
    // Right angles leave no rounding noise where there should be zeros.
    CHECK(a.column_x.x == 0);
    CHECK(a.column_x.z == 0);
    CHECK(a.column_y.y == 0);
    CHECK(a.column_z.y == 0);
}

TEST_CASE("each field of the keys is a track of its own") {
    const Scene scene = with_model(
        R"("translate": [5, 0, 0], "rotate": [0, 90, 0], "scale": 2, "keys": [
            {"time": 1, "translate": [1, 0, 0]},
            {"time": 2, "rotate": [0, 180, 0]},
            {"time": 3, "translate": [3, 0, 0]}])");
    const TransformTrack& t = transform_of(scene);
    // translate: keys at 1 and 3; its static value is hidden by the first key.
    CHECK(t.translate.keys.size() == 2);
    CHECK(evaluate(t.translate, 0).x == 1);
    CHECK(evaluate(t.translate, 2).x == 2);
    // rotate: the first key omits it, so 90 degrees stand at its time.
    CHECK(t.rotate.keys.size() == 2);
    CHECK(t.rotate.keys[0].time == 1);
    const glm::dquat middle = evaluate(t.rotate, 1.5);
    CHECK(middle.y == doctest::Approx(std::sin(degrees(67.5))).epsilon(1e-12));
    // scale: in no key, it does not move.
    CHECK_FALSE(t.scale.moves());
    CHECK(evaluate(t.scale, 2).y == 2);
}

TEST_CASE("a field without a static value takes the default at the first key") {
    const Scene scene = with_model(R"("keys": [{"time": 0}, {"time": 2, "translate": [4, 0, 0]}])");
    CHECK(evaluate(transform_of(scene).translate, 1).x == 2);
}

TEST_CASE("camera, lights and their radiance move by keys") {
    const Scene scene = read_scene_text(R"({
        "camera": {"target": [0,0,0], "vfov": 30, "keys": [
            {"time": 0, "eye": [0,0,4]}, {"time": 2, "eye": [2,0,4], "vfov": 50}]},
        "lights": [{"type": "polygon", "radiance": [1,1,1], "vertices": [[0,1,0],[1,1,0],[0,1,1]],
            "keys": [{"time": 0}, {"time": 4, "radiance": [5,1,1], "vertices": [[4,1,0],[5,1,0],[4,1,1]]}]}]})",
                                        {});
    CHECK(evaluate(scene.camera.eye, 1).x == 1);
    CHECK(evaluate(scene.camera.vertical_field_of_view, 1) == 40);
    CHECK(evaluate(scene.lights[0].emission.radiance, 2).x == 3);
    const auto& polygon = std::get<PolygonTrack>(scene.lights[0].shape);
    CHECK(evaluate(polygon.vertices[0], 2).x == 2);
    CHECK(evaluate(polygon.vertices[2], 4).z == 1);
}
