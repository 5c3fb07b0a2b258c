#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "core/scene/digest.h"
#include "core/scene/light_polygon.h"
#include "core/scene/scene_view.h"
#include "tests/core/scene_testing.h"

using namespace penumbra;
using penumbra::testing::read_with;
using penumbra::testing::SceneFolder;

namespace {

constexpr FilmSize kFilm{640, 480};

// A tetrahedron with its outside to the outside, emitting.
const VirtualFiles kTetrahedron{{"t.obj",
                                 "mtllib t.mtl\nusemtl lamp\nv 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf "
                                 "1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"},
                                {"t.mtl", "newmtl lamp\nKe 1 1 1\n"}};

Scene tetrahedron(std::string_view placement) {
    return read_scene_text(fmt::format(R"({{"models": [{{"file": "t.obj"{}{}}}]}})",
                                       placement.empty() ? "" : ", ", placement),
                           kTetrahedron);
}

SceneView view_at(const Scene& scene, double time, double previous) {
    SceneView view;
    evaluate(scene, {time, previous}, kFilm, view);
    return view;
}

Vec3d wide(const Vec3f& v) {
    return {v.x, v.y, v.z};
}

Vec3d center_of(const Instance& instance) {
    Vec3d sum{0, 0, 0};
    for (std::size_t i = 0; i + 1 < instance.positions.size(); ++i)
        sum += wide(instance.positions[i]);
    return sum / static_cast<double>(instance.positions.size() - 1);
}

void check_equal(const Vec3f& a, const Vec3f& b) {
    CHECK(a.x == b.x);
    CHECK(a.y == b.y);
    CHECK(a.z == b.z);
}
void check_near(const Vec3f& a, const Vec3d& b, double tolerance) {
    CHECK(length(wide(a) - b) <= tolerance);
}

}  // namespace

TEST_CASE("positions go through scale, rotation and translation") {
    const Scene scene =
        tetrahedron(R"("scale": [1, 2, 1], "rotate": [0, 90, 0], "translate": [10, 0, 0])");
    const SceneView view = view_at(scene, 0, 0);
    // A quarter turn about y takes x to -z and z to x.
    for (std::size_t i = 0; i < scene.meshes[0].positions.size(); ++i) {
        const Vec3f& p = scene.meshes[0].positions[i];
        check_near(view.instances[0].positions[i], {10.0 + p.z, 2.0 * p.y, -1.0 * p.x}, 1e-6);
    }
    CHECK(view.instances[0].positions.size() == scene.meshes[0].positions.size() + 1);
    CHECK(view.bounds_max.x == 13);
    CHECK(view.bounds_max.y == 4);
    CHECK(view.bounds_min.z == -1);
}

TEST_CASE("normals stay at right angles to their faces and point outside, mirrored or not") {
    for (const char* placement :
         {"\"scale\": [1, 5, 0.1]", "\"scale\": [-1, 2, 3], \"rotate\": [30, 40, 50]",
          "\"scale\": -2", "\"scale\": [1e-4, -1e-4, -1e-4]"}) {
        CAPTURE(placement);
        const Scene scene = tetrahedron(placement);
        const SceneView view = view_at(scene, 0, 0);
        const Instance& instance = view.instances[0];
        const Vec3d center = center_of(instance);
        for (const Triangle& t : scene.meshes[0].triangles) {
            const Vec3d a = wide(instance.positions[t.vertex[0]]);
            const Vec3d b = wide(instance.positions[t.vertex[1]]);
            const Vec3d c = wide(instance.positions[t.vertex[2]]);
            const Vec3d winding = normalize(cross(b - a, c - a));
            const Vec3d normal = wide(instance.normals[t.vertex[0]]);
            CHECK(length(normal) == doctest::Approx(1).epsilon(1e-6));
            CHECK(dot(normal, a - center) > 0);
            // The winding agrees with the outside unless the transform mirrors.
            CHECK(dot(winding, normal) ==
                  doctest::Approx(instance.flips_winding ? -1 : 1).epsilon(1e-5));
        }
    }
    CHECK(view_at(tetrahedron(R"("scale": -2)"), 0, 0).instances[0].flips_winding);
    CHECK_FALSE(view_at(tetrahedron(R"("scale": [-1, -1, 1])"), 0, 0).instances[0].flips_winding);
}

TEST_CASE("emitters emit to the model's outside, mirrored or not, with their world area") {
    for (const char* placement :
         {"\"scale\": 2", "\"scale\": [-2, 2, 2], \"translate\": [5, 5, 5]"}) {
        const Scene scene = tetrahedron(placement);
        const SceneView view = view_at(scene, 0, 0);
        REQUIRE(view.lights.size() == 4);
        const Vec3d center = center_of(view.instances[0]);
        double area = 0;
        for (const PolygonLight& light : view.lights.polygons) {
            CHECK(dot(wide(light.shape.normal), wide(light.shape.center) - center) > 0);
            CHECK(light.is_geometry);
            CHECK_FALSE(light.visible);
            std::vector<Vec3d> vertices;
            for (int i = 0; i < light.shape.count; ++i)
                vertices.push_back(wide(light.shape.vertices[i]));
            CHECK(dot(newell_normal(vertices), wide(light.shape.normal)) ==
                  doctest::Approx(2 * light.shape.area).epsilon(1e-5));
            area += light.shape.area;
        }
        CHECK(area == doctest::Approx(4 * (1 + 1.5 + 3 + 3.5)).epsilon(1e-6));
    }
}

TEST_CASE("a rect emits to the side of u x v, and so does its polygon") {
    const Scene scene = read_with(R"("lights": [
        {"type": "rect", "center": [0,3,0], "u": [0.5,0,0], "v": [0,0,0.25], "radiance": [1,2,3], "two_sided": true, "visible": false}])");
    const SceneView view = view_at(scene, 0, 0);
    REQUIRE(view.lights.size() == 1);
    const PolygonLight& light = view.lights.polygons[0];
    CHECK(light.shape.count == 4);
    check_equal(light.shape.normal, {0, -1, 0});
    check_equal(light.shape.center, {0, 3, 0});
    CHECK(light.shape.area == 0.5f);
    CHECK(light.shape.two_sided);
    CHECK_FALSE(light.visible);
    CHECK_FALSE(light.is_geometry);
    CHECK(light.emission.radiance.z == 3);
    const Vec3f turn = cross(light.shape.vertices[1] - light.shape.vertices[0],
                             light.shape.vertices[2] - light.shape.vertices[1]);
    CHECK(turn.y < 0);
}

TEST_CASE("lights stand in the scene file's order, each as what its kind is") {
    const Scene scene = read_with(R"("lights": [
        {"type": "polygon", "vertices": [[0,1,0],[1,1,0],[0,1,1]], "radiance": [1,0,0]},
        {"type": "rect", "center": [0,3,0], "u": [1,0,0], "v": [0,0,1], "radiance": [2,0,0]},
        {"type": "polygon", "vertices": [[0,2,0],[1,2,0],[1,2,1],[0.5,2,2],[0,2,1]], "radiance": [3,0,0]}])");
    CHECK(kind_name(scene.lights[0].shape) == std::string("polygon"));
    CHECK(kind_name(scene.lights[1].shape) == std::string("rect"));
    const SceneView view = view_at(scene, 0, 0);
    REQUIRE(view.lights.size() == 3);
    constexpr int kVertices[] = {3, 4, 5};
    for (std::uint32_t i = 0; i < 3; ++i)
        with_light(view.lights.view(), i, [&](const PolygonLight& light) {
            CHECK(light.emission.radiance.x == static_cast<float>(i + 1));
            CHECK(light.shape.count == kVertices[i]);
        });
}

TEST_CASE("a light too small for its distance has no shape, and keeps its place among the others") {
    const Scene scene = read_with(R"("lights": [
        {"type": "rect", "center": [1e6,3,0], "u": [1e-3,0,0], "v": [0,0,1], "radiance": [1,1,1]},
        {"type": "rect", "center": [0,3,0], "u": [1e-3,0,0], "v": [0,0,1], "radiance": [1,1,1]}])");
    const SceneView view = view_at(scene, 0, 0);
    REQUIRE(view.lights.size() == 2);
    CHECK(view.lights.polygons[0].shape.count == 0);
    CHECK(view.lights.polygons[1].shape.count == 4);
}

TEST_CASE("the motion transform takes a world position to where it was") {
    const Scene scene = tetrahedron(R"("scale": 2, "keys": [
        {"time": 0, "rotate": [0, 0, 0]}, {"time": 1, "rotate": [10, 120, -30], "translate": [3, 4, 5]}])");
    const SceneView now = view_at(scene, 0.75, 0.5);
    const SceneView before = view_at(scene, 0.5, 0.5);
    for (std::size_t i = 0; i < scene.meshes[0].positions.size(); ++i)
        check_near(now.instances[0].previous_from_current.point(now.instances[0].positions[i]),
                   wide(before.instances[0].positions[i]), 3e-6);
    CHECK(before.instances[0].previous_from_current == Affine3f{});
    CHECK(now.instances[0].is_animated);
}

TEST_CASE("a view that is used again holds what a fresh one would") {
    const Scene scene = read_scene_text(R"({"models": [
        {"name": "still", "file": "t.obj"},
        {"name": "moving", "file": "t.obj", "keys": [{"time": 0, "translate": [0,0,0]}, {"time": 4, "translate": [4,1,0]}]}]})",
                                        kTetrahedron);
    SceneView reused;
    for (const double time : {0.0, 3.0, 1.0, 1.0, 2.0}) {
        const Vec3f* const before =
            reused.instances.empty() ? nullptr : reused.instances[0].positions.data();
        const bool repeated = time == 1.0 && before && reused.instances[1].positions[0].x == 1;
        evaluate(scene, {time, time - 0.25}, kFilm, reused);
        const SceneView fresh = view_at(scene, time, time - 0.25);
        for (std::size_t i = 0; i < 2; ++i)
            for (std::size_t k = 0; k < fresh.instances[i].positions.size(); ++k)
                check_equal(reused.instances[i].positions[k], fresh.instances[i].positions[k]);
        CHECK(reused.lights.size() == fresh.lights.size());
        check_equal(reused.bounds_max, fresh.bounds_max);
        // What stands still is not computed again.
        CHECK(reused.instances[0].moved == (before == nullptr));
        CHECK(reused.instances[1].moved == !repeated);
        if (before) CHECK(reused.instances[0].positions.data() == before);
    }
}

TEST_CASE("the camera's frame is orthonormal and projects as the field of view says") {
    const Scene scene = read_with(R"("film": {"size": [640, 480]})");
    SceneView view = view_at(scene, 0, 0);
    const Camera& camera = view.camera;
    check_equal(camera.forward, {0, 0, -1});
    check_equal(camera.right, {1, 0, 0});
    check_equal(camera.up, {0, 1, 0});
    CHECK(camera.center_x == 320);
    CHECK(camera.center_y == 240);
    // Half the film's height at distance 5 is 5 tan(45 / 2).
    const double half_height = 5 * std::tan(45 * std::numbers::pi / 360);
    CHECK(camera.focal * half_height / 5 == doctest::Approx(240).epsilon(1e-6));
}

TEST_CASE("the near distance is given, or small against scene and target distance") {
    const auto near_of = [](std::string_view camera) {
        const Scene scene = read_scene_text(
            fmt::format(R"({{"camera": {{{}}}, "models": [{{"file": "t.obj"}}]}})", camera),
            kTetrahedron);
        return view_at(scene, 0, 0).camera.near_distance;
    };
    CHECK(near_of(R"("eye": [0,0,9], "target": [0,0,0], "near": 0.5)") == 0.5f);
    CHECK(near_of(R"("eye": [0,0,9], "target": [0,0,0])") ==
          doctest::Approx(1e-4 * std::sqrt(14.0)).epsilon(1e-5));
    CHECK(near_of(R"("eye": [0,0,0.001], "target": [0,0,0])") == doctest::Approx(1e-5));
}

TEST_CASE("frames lie on the grid of the frame rate, the first at time zero") {
    const Animation animation{.frames_per_second = 24, .first_frame = 10, .last_frame = 20};
    CHECK(times_of_frame(animation, 10).now == 0);
    CHECK(times_of_frame(animation, 34).now == 1);
    CHECK(times_of_frame(animation, 34).previous == 23.0 / 24);
}

TEST_CASE("what reaches beyond float's comfort is refused") {
    const Scene scene = tetrahedron(R"("translate": [9.9e8, 0, 0], "scale": [1e6, 1e6, 1e6])");
    CHECK_NOTHROW(view_at(scene, 0, 0));
    const Scene wider = tetrahedron(
        R"("translate": [9.9e8, 0, 0], "scale": [-1e6, 1e6, 1e6], "rotate": [0, 180, 0], "keys": [{"time": 0, "translate": [1e9, 1, 1]}])");
    CHECK_THROWS_AS(view_at(wider, 0, 0), InputError);
}

TEST_CASE("a model alone is framed whole, whatever its place, size and shape") {
    for (const auto& [scale, offset] : {std::pair{1.0, 0.0}, {1000.0, 5000.0}, {0.001, 1.0}})
        for (const double depth : {0.0, 1.0, 20.0}) {
            std::string obj;
            for (int i = 0; i < 8; ++i)
                obj += fmt::format("v {} {} {}\n", offset + scale * (i & 1),
                                   offset + scale * (i >> 1 & 1) * 3,
                                   offset + scale * (i >> 2) * depth);
            const SceneFolder folder;
            const Scene scene = read_scene(folder.write("m.obj", obj + "f 1 2 4 3\nf 5 6 8 7\n"));
            SceneView view;
            evaluate(scene, {}, {1920, 1080}, view);
            double widest = 0;
            for (std::size_t i = 0; i + 1 < view.instances[0].positions.size(); ++i) {
                const Vec3f p = view.camera.view_from_world(view.instances[0].positions[i]);
                CHECK(p.z > view.camera.near_distance);
                const double x = std::fabs(view.camera.focal * p.x / p.z) / 960;
                const double y = std::fabs(view.camera.focal * p.y / p.z) / 540;
                widest = std::max({widest, x, y});
            }
            CHECK(widest < 0.97);
            CHECK(widest > 0.8);
            // The default light faces the model and is not in the picture.
            REQUIRE(view.lights.size() == 1);
            const Vec3f center = (view.bounds_min + view.bounds_max) * 0.5f;
            const Vec3f from_light = center - view.lights.polygons[0].shape.center;
            CHECK(dot(from_light, view.lights.polygons[0].shape.normal) >
                  0.99f * length(from_light));
            CHECK_FALSE(view.lights.polygons[0].visible);
            // A grey surface at the centre that faces it is exposed well: E albedo / pi.
            const float distance = length(from_light);
            const float radiance = view.lights.polygons[0].emission.radiance.x *
                                   view.lights.polygons[0].shape.area / (distance * distance) *
                                   0.5f / std::numbers::pi_v<float>;
            CHECK(radiance > 0.4f);
            CHECK(radiance < 1);
        }
}

TEST_CASE("the digest follows contents, not names or places") {
    const SceneFolder one;
    const SceneFolder other;
    const auto fill = [](const SceneFolder& folder, std::string_view obj) {
        folder.write("deep/t.obj", obj);
        folder.write("deep/t.mtl", "newmtl lamp\nKe 1 1 1\n");
        return digest_of(
            read_scene(folder.write("a.json", R"({"models": [{"file": "deep/t.obj"}]})")));
    };
    const Digest digest = fill(one, kTetrahedron.at("t.obj"));
    CHECK(digest == fill(other, kTetrahedron.at("t.obj")));
    CHECK(digest.hex().size() == 32);
    CHECK(digest != fill(other, kTetrahedron.at("t.obj") + "#"));
    // A library that the model names counts too.
    fill(other, kTetrahedron.at("t.obj"));
    other.write("deep/t.mtl", "newmtl lamp\nKe 1 1 2\n");
    CHECK(digest != digest_of(read_scene(other / "a.json")));
}

TEST_CASE("the digest tells apart contents that are the same when strung together") {
    CHECK(digest_of("", {{"a", "xy"}, {"b", "z"}}) != digest_of("", {{"a", "x"}, {"b", "yz"}}));
    CHECK(digest_of("", {{"a", "x"}}) == digest_of("", {{"b", "x"}}));
}

TEST_CASE("the file list holds all that was read, once, in the order of reading") {
    const SceneFolder folder;
    folder.write("t.obj", kTetrahedron.at("t.obj"));
    folder.write("t.mtl", kTetrahedron.at("t.mtl"));
    const Scene scene = read_scene(
        folder.write("a.json", R"({"models": [{"file": "t.obj"}, {"file": "./t.obj"}]})"));
    REQUIRE(scene.files.size() == 3);
    CHECK(scene.files[0].filename() == "a.json");
    CHECK(scene.files[1].filename() == "t.obj");
    CHECK(scene.files[2].filename() == "t.mtl");
    CHECK(scene.meshes.size() == 1);
    CHECK(scene.models.size() == 2);
}
