#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "core/scene/light_polygon.h"
#include "core/scene/merge_emitters.h"
#include "tests/core/scene_testing.h"

using namespace penumbra;
using penumbra::testing::read_obj_text;

namespace {

std::vector<LightPolygon> emitters_of(std::string_view obj) {
    const Scene scene = read_obj_text("mtllib model.mtl\nusemtl lamp\n" + std::string(obj),
                                      "newmtl lamp\nKe 1 2 3\n");
    std::vector<LightPolygon> polygons;
    for (const Emitter& e : scene.emitters) polygons.push_back(e.polygon);
    return polygons;
}

std::vector<Vec3d> vertices_of(const LightPolygon& polygon) {
    std::vector<Vec3d> result;
    for (int i = 0; i < polygon.vertex_count; ++i) {
        const Vec3f& v = polygon.vertices[static_cast<std::size_t>(i)];
        result.push_back({v.x, v.y, v.z});
    }
    return result;
}

double area_of(const std::vector<LightPolygon>& polygons) {
    return std::accumulate(polygons.begin(), polygons.end(), 0.0, [](double sum, const auto& p) {
        return sum + length(newell_normal(vertices_of(p))) / 2;
    });
}

void check_all_convex(const std::vector<LightPolygon>& polygons) {
    for (const LightPolygon& p : polygons) CHECK_FALSE(polygon_problem(vertices_of(p)));
}

// A grid of squares in the plane z = 0, each of two triangles; `has` says which squares are there.
template <class Has>
std::string grid(int width, int height, const Has& has) {
    std::string obj;
    for (int y = 0; y <= height; ++y)
        for (int x = 0; x <= width; ++x) obj += fmt::format("v {} {} 0\n", x * 0.1, y * 0.1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (!has(x, y)) continue;
            const int a = y * (width + 1) + x + 1;
            const int d = a + width + 1;
            obj += fmt::format("f {} {} {}\nf {} {} {}\n", a, a + 1, d + 1, a, d + 1, d);
        }
    return obj;
}

std::string regular_polygon(int sides) {
    std::string obj;
    std::string face = "f";
    for (int i = 0; i < sides; ++i) {
        const double a = 2 * std::numbers::pi * i / sides;
        obj += fmt::format("v {:.7f} {:.7f} 0\n", std::cos(a), std::sin(a));
        face += fmt::format(" {}", i + 1);
    }
    return obj + face + "\n";
}

}  // namespace

TEST_CASE("two triangles of a square are one light, which emits to the side of their winding") {
    const auto lights = emitters_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
    REQUIRE(lights.size() == 1);
    CHECK(lights[0].vertex_count == 4);
    CHECK(newell_normal(vertices_of(lights[0])).z == doctest::Approx(2));
    const auto turned = emitters_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 3 2\nf 1 4 3\n");
    REQUIRE(turned.size() == 1);
    CHECK(newell_normal(vertices_of(turned[0])).z == doctest::Approx(-2));
}

TEST_CASE("a grid of any size is one rectangle; vertices on its edges are left out") {
    for (const auto& [w, h] : {std::pair{2, 2}, {7, 1}, {40, 30}}) {
        const auto lights = emitters_of(grid(w, h, [](int, int) { return true; }));
        REQUIRE(lights.size() == 1);
        CHECK(lights[0].vertex_count == 4);
        CHECK(area_of(lights) == doctest::Approx(w * h * 0.01).epsilon(1e-5));
    }
}

TEST_CASE("regular polygons of up to eight corners are one light, larger ones several") {
    for (int sides = 3; sides <= 8; ++sides) {
        const auto lights = emitters_of(regular_polygon(sides));
        REQUIRE(lights.size() == 1);
        CHECK(lights[0].vertex_count == sides);
    }
    const auto many = emitters_of(regular_polygon(20));
    CHECK(many.size() >= 2);
    CHECK(many.size() <= 9);
    check_all_convex(many);
    CHECK(area_of(many) == doctest::Approx(10 * std::sin(2 * std::numbers::pi / 20)).epsilon(1e-5));
}

TEST_CASE("an L, a frame and a checkerboard become convex parts of the same area") {
    struct Case {
        int size;
        bool (*has)(int, int);
    };
    const std::vector<Case> cases{
        {2, [](int x, int y) { return x == 0 || y == 0; }},
        {4, [](int x, int y) { return x == 0 || y == 0 || x == 3 || y == 3; }},
        {6, [](int x, int y) { return (x + y) % 2 == 0; }},
        {9, [](int x, int y) { return (x * 7 + y * 5) % 3 != 0; }}};
    for (const Case& c : cases) {
        int squares = 0;
        for (int i = 0; i < c.size * c.size; ++i) squares += c.has(i % c.size, i / c.size) ? 1 : 0;
        const auto lights = emitters_of(grid(c.size, c.size, c.has));
        CHECK(lights.size() >= 2);
        CHECK(lights.size() <= static_cast<std::size_t>(squares));
        check_all_convex(lights);
        CHECK(area_of(lights) == doctest::Approx(squares * 0.01).epsilon(1e-5));
    }
}

TEST_CASE("the faces of a box stay apart") {
    const auto lights = emitters_of(R"(
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)");
    CHECK(lights.size() == 6);
    // They emit outwards.
    for (const LightPolygon& p : lights) {
        Vec3d middle{-0.5, -0.5, -0.5};
        for (const Vec3d& v : vertices_of(p)) middle += v * 0.25;
        CHECK(dot(middle, newell_normal(vertices_of(p))) > 0.9);
    }
}

TEST_CASE("a slightly bent square stays two lights") {
    CHECK(emitters_of("v 0 0 0\nv 1 0 0\nv 1 1 0.001\nv 0 1 0\nf 1 2 3\nf 1 3 4\n").size() == 2);
}

TEST_CASE("triangles of opposite winding stay apart") {
    CHECK(emitters_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 4 3\n").size() == 2);
    CHECK(emitters_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 1 3 2\n").size() == 2);
}

TEST_CASE("squares that touch at a corner or along half an edge keep their areas") {
    const auto corner = emitters_of(grid(2, 2, [](int x, int y) { return x == y; }));
    CHECK(corner.size() == 2);
    // A T-junction: the right square has no vertex where the two left ones meet.
    const auto junction = emitters_of(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 2 0\nv 0 2 0\nv 3 0 0\nv 3 2 0\n"
        "f 1 2 3 4\nf 4 3 5 6\nf 2 7 8 5\n");
    check_all_convex(junction);
    CHECK(area_of(junction) == doctest::Approx(6));
}

TEST_CASE("emitters join where positions repeat, far from the origin too") {
    const auto lights = emitters_of(
        "v 6000.1 2000.3 -1000\nv 6001.1 2000.3 -1000\nv 6001.1 2001.3 -1000\n"
        "v 6000.1 2000.3 -1000\nv 6001.1 2001.3 -1000\nv 6000.1 2001.3 -1000\nf 1 2 3\nf 4 5 6\n");
    CHECK(lights.size() == 1);
}

TEST_CASE("overlapping and repeated emissive faces are each counted") {
    const auto lights = emitters_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\nf 2 3 1\n");
    CHECK(lights.size() == 3);
    CHECK(area_of(lights) == doctest::Approx(1.5));
}

TEST_CASE("only faces whose material emits become lights, and they take its radiance") {
    const Scene scene = read_obj_text(
        "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wall\nf 1 2 3\nusemtl lamp\nf 1 2 3\n",
        "newmtl wall\nKe 0 0 0\nnewmtl lamp\nKe 1 2 3\n");
    REQUIRE(scene.emitters.size() == 1);
    CHECK(scene.emitters[0].radiance.z == 3);
    CHECK(scene.lights.empty());
    CHECK(scene.warnings.empty());
}
