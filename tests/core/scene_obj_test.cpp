#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "core/scene/polygon_soup.h"
#include "core/scene/read_obj.h"
#include "core/scene/triangulate.h"
#include "tests/core/scene_testing.h"

using namespace penumbra;
using penumbra::testing::read_obj_text;
using penumbra::testing::SceneFolder;

namespace {

Mesh mesh_of(std::string_view obj) {
    return read_obj_text(obj).meshes[0];
}

double area_of(const Mesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        const auto p = [&](int i) {
            const Vec3f& v = mesh.positions[t.vertex[i]];
            return Vec3d{v.x, v.y, v.z};
        };
        sum += length(cross(p(1) - p(0), p(2) - p(0))) / 2;
    }
    return sum;
}

Vec3f face_normal(const Mesh& mesh, const Triangle& t) {
    const Vec3f& a = mesh.positions[t.vertex[0]];
    return normalize(cross(mesh.positions[t.vertex[1]] - a, mesh.positions[t.vertex[2]] - a));
}

constexpr std::string_view kCube = R"(
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
)";

std::string cylinder(int sides) {
    std::ostringstream obj;
    obj.precision(9);
    for (int i = 0; i < sides; ++i) {
        const double a = 2 * std::numbers::pi * i / sides;
        obj << "v " << std::cos(a) << " 0 " << -std::sin(a) << "\n";
        obj << "v " << std::cos(a) << " 1 " << -std::sin(a) << "\n";
    }
    const auto bottom = [&](int i) { return 2 * (i % sides) + 1; };
    for (int i = 0; i < sides; ++i)
        obj << "f " << bottom(i) << " " << bottom(i + 1) << " " << bottom(i + 1) + 1 << " "
            << bottom(i) + 1 << "\n";
    obj << "f";
    for (int i = 0; i < sides; ++i) obj << " " << bottom(i) + 1;
    obj << "\n";
    return obj.str();
}

}  // namespace

TEST_CASE("bad OBJ lines are refused with the line and what was expected") {
    const SceneFolder folder;
    const auto error = [&](std::string_view text) { return folder.error_of_obj(text); };
    CHECK(error("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n") ==
          "model.obj: line 4: face uses vertex 9, but only 3 are defined");
    CHECK(error("v 0 0 0\nf 1 -2 1\n") ==
          "model.obj: line 2: face uses vertex -2, but only 1 is defined");
    CHECK(error("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/1 3/1\n") ==
          "model.obj: line 4: face uses texture coordinate 1, but only 0 are defined");
    CHECK(error("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//2 3//1\n") ==
          "model.obj: line 5: face uses normal 2, but only 1 is defined");
    CHECK(error("v 0 nan 0\n") == "model.obj: line 1: expected a number, got \"nan\"");
    CHECK(error("v 0 inf 0\n") == "model.obj: line 1: expected a number, got \"inf\"");
    CHECK(error("v 0 1e 0\n") == "model.obj: line 1: expected a number, got \"1e\"");
    CHECK(error("# c\r\n\r\nv 0 1e39 0\r\n") ==
          "model.obj: line 3: the number inf is beyond 1e+15");
    CHECK(error("v 0 0\n") == "model.obj: line 1: expected 3 numbers, got 2");
    CHECK(error("vn 0 0 1 1\n") == "model.obj: line 1: expected 3 numbers, got 4");
    CHECK(error("vt x\n") == "model.obj: line 1: expected a number, got \"x\"");
    CHECK(error("v 0 0 0\nf 0 1 1\n") ==
          "model.obj: line 2: expected a vertex like 7, 7/1, 7//3 or 7/1/3, got \"0\"");
    CHECK(error("v 0 0 0\nf 1 99999999999 1\n") ==
          "model.obj: line 2: expected a vertex like 7, 7/1, 7//3 or 7/1/3, got \"99999999999\"");
    CHECK(error("f a b c\n").starts_with("model.obj: line 1: expected a vertex like"));
    CHECK(error("f\n") == "model.obj: line 1: a face without vertices");
    CHECK(error(std::string_view("v 0 0 0\0\n", 9)) ==
          "model.obj: line 1: holds a zero byte: not a text file");
    CHECK(error("v 0 0 0\nf 1 1 1\n") == "model.obj: all its faces are degenerate");
    CHECK(error("") == "model.obj: holds no faces");
    CHECK(error("\x89PNG\r\n\x1a\nIHDR") == "model.obj: holds no faces");
}

TEST_CASE("a face with too many corners is refused") {
    const SceneFolder folder;
    std::string obj;
    std::string face = "f";
    for (int i = 1; i <= 10001; ++i) {
        obj += fmt::format("v {} {} 0\n", std::cos(i * 6e-4), std::sin(i * 6e-4));
        face += fmt::format(" {}", i);
    }
    CHECK(folder.error_of_obj(obj + face + "\n") ==
          "model.obj: line 10002: a face of 10001 vertices, expected at most 10000");
}

TEST_CASE("negative indices, CRLF, tabs, comments, continued lines and dangling slashes are read") {
    const Mesh plain = mesh_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const std::string_view text :
         {"v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf -3 -2 -1\r\n",
          "v\t0 0 0\n v 1 0 0 # x\nv 0 1 0\nf 1 2 \\\n 3",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/ 2// 3\n", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",
          "v 0 0 0 1\nv +1. .0 0\nv 0 1e0 -0\nf 1 2 3 # end\np 1\nl 1 2\ng\ns off\nt x 9/9/9\n"}) {
        const Mesh mesh = mesh_of(text);
        REQUIRE(mesh.positions.size() == 3);
        REQUIRE(mesh.triangles.size() == 1);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(mesh.positions[i].x == plain.positions[i].x);
            CHECK(mesh.positions[i].y == plain.positions[i].y);
        }
    }
}

TEST_CASE("line numbers count as editors do, whatever the line ends") {
    const SceneFolder folder;
    for (const std::string_view end : {"\n", "\r\n", "\r"}) {
        const std::string text = fmt::format("v 0 0 0{0}{0}# x{0}f 1 1 7{0}", end);
        CHECK(folder.error_of_obj(text).starts_with("model.obj: line 4: "));
    }
}

TEST_CASE("line numbers stay right in long files, wherever blocks end") {
    const SceneFolder folder;
    // 17 bytes divide 2^20 + 1: the first block of 1 MiB ends between "\r" and "\n".
    for (const std::size_t width : {14, 61, 62}) {
        std::string text;
        std::size_t lines = 0;
        for (; text.size() < 3500000; ++lines) text.append("#").append(width, 'x').append("\r\n");
        CHECK(folder.error_of_obj(text + "f 1\r\n") ==
              fmt::format("model.obj: line {}: face uses vertex 1, but only 0 are defined",
                          lines + 1));
    }
}

TEST_CASE("triangles without area are dropped and counted") {
    const Scene scene = read_obj_text(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 1 0 0\nf 1 2 3\nf 1 2 2\nf 1 2 4\nf 2 5 3\nf 1 2\n");
    CHECK(scene.meshes[0].triangles.size() == 1);
    CHECK(scene.meshes[0].dropped_triangles == 4);
    REQUIRE(scene.warnings.size() >= 1);
    CHECK(scene.warnings[0] == "model.obj: 4 triangles without area were dropped");
}

TEST_CASE("polygons, concave ones too, are cut into triangles of the same area and winding") {
    struct Case {
        std::string obj;
        double area;
        std::size_t triangles;
    };
    // A concave quad (an arrow head), an L, a comb, and a square with a hole joined by a bridge.
    const std::vector<Case> cases{
        {"v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf 1 2 3 4\n", 4, 2},
        {"v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf 2 3 4 1\n", 4, 2},
        {"v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 1 2 3 4 5 6\n", 5, 4},
        {"v 0 0 0\nv 5 0 0\nv 5 3 0\nv 4 3 0\nv 4 1 0\nv 3 1 0\nv 3 3 0\nv 2 3 0\nv 2 1 0\nv 1 1 "
         "0\n"
         "v 1 3 0\nv 0 3 0\nf 1 2 3 4 5 6 7 8 9 10 11 12\n",
         11, 10},
        {"v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\n"
         "f 1 2 3 4 1 5 6 7 8 5\n",
         12, 8},
        // Corners on straight edges.
        {"v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 2 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n", 4, 4}};
    for (const Case& c : cases) {
        CAPTURE(c.obj);
        const Mesh mesh = mesh_of(c.obj);
        CHECK(mesh.triangles.size() == c.triangles);
        CHECK(mesh.dropped_triangles == 0);
        CHECK(area_of(mesh) == doctest::Approx(c.area).epsilon(1e-6));
        for (const Triangle& t : mesh.triangles) CHECK(face_normal(mesh, t).z > 0.99f);
    }
}

TEST_CASE("a large spiral polygon is cut in every direction it may face") {
    std::vector<Vec3f> ring;
    for (int i = 0; i < 150; ++i)
        ring.push_back(
            {0.1f * (10 + i) * std::cos(0.1f * i), 0.1f * (10 + i) * std::sin(0.1f * i), 0});
    for (int i = 149; i >= 0; --i)
        ring.push_back(
            {0.1f * (14 + i) * std::cos(0.1f * i), 0.1f * (14 + i) * std::sin(0.1f * i), 0});
    for (int axis = 0; axis < 6; ++axis) {
        std::vector<Vec3f> turned;
        for (const Vec3f& p : ring) {
            const std::array<Vec3f, 3> orders{Vec3f{p.x, p.y, 0}, Vec3f{0, p.x, p.y},
                                              Vec3f{p.y, 0, p.x}};
            turned.push_back(orders[static_cast<std::size_t>(axis % 3)]);
        }
        if (axis >= 3) std::reverse(turned.begin(), turned.end());
        double signed_area = 0;
        double area = 0;
        for (const auto& [a, b, c] : triangulate(turned)) {
            const Vec3f n = cross(turned[b] - turned[a], turned[c] - turned[a]);
            signed_area += n.x + n.y + n.z;
            area += length(n);
        }
        CHECK(std::fabs(signed_area) == doctest::Approx(area).epsilon(1e-4));
    }
}

TEST_CASE("missing normals break at the edges of a cube") {
    const Mesh mesh = mesh_of(kCube);
    CHECK(mesh.triangles.size() == 12);
    CHECK(mesh.positions.size() == 24);
    for (const Triangle& t : mesh.triangles)
        for (const auto v : t.vertex)
            CHECK(dot(mesh.normals[v], face_normal(mesh, t)) == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("missing normals are radial on a cylinder's side and break at its rim") {
    const Mesh mesh = mesh_of(cylinder(12));
    CHECK(mesh.positions.size() == 36);  // each rim vertex is on the side and on the cap
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3f& n = mesh.normals[i];
        const Vec3f& p = mesh.positions[i];
        const bool on_cap = n.y > 0.5f;
        CHECK(n.y == doctest::Approx(on_cap ? 1 : 0).epsilon(1e-6));
        if (!on_cap) CHECK(n.x * p.x + n.z * p.z == doctest::Approx(1).epsilon(1e-5));
    }
}

TEST_CASE("eight sides are round, six are not") {
    CHECK(mesh_of(cylinder(8)).positions.size() == 8 * 3);
    CHECK(mesh_of(cylinder(6)).positions.size() == 6 * 5);
}

TEST_CASE("missing normals join positions of equal coordinates") {
    // The same ridge of 20 degrees, once with shared and once with repeated positions.
    const Mesh shared = mesh_of("v 0 0 0\nv 0 0 1\nv 1 -0.2 0\nv -1 -0.2 0\nf 1 2 3\nf 1 4 2\n");
    const Mesh repeated =
        mesh_of("v 0 0 0\nv 0 0 1\nv 1 -0.2 0\nf 1 2 3\nv 0 0 0\nv -0 0 1\nv -1 -0.2 0\nf 4 6 5\n");
    CHECK(shared.positions.size() == 4);
    for (const Mesh* mesh : {&shared, &repeated})
        for (std::size_t i = 0; i < mesh->positions.size(); ++i)
            if (mesh->positions[i].x == 0)
                CHECK(mesh->normals[i].y == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("missing normals do not depend on how a polygon was cut") {
    // The corner of a box whose faces are bevelled to less than the crease angle would weigh twice
    // where two triangles meet; by angle it does not.
    const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 -1 -0.5\nv 1 -1 -0.5\n";
    const Mesh one = mesh_of(points + "f 1 2 3 4\nf 1 5 6 2\n");
    const Mesh other = mesh_of(points + "f 1 2 4\nf 2 3 4\nf 1 5 2\nf 5 6 2\n");
    const auto normal_at_origin = [](const Mesh& m) {
        for (std::size_t i = 0; i < m.positions.size(); ++i)
            if (length_squared(m.positions[i]) == 0) return m.normals[i];
        return Vec3f{};
    };
    CHECK(dot(normal_at_origin(one), normal_at_origin(other)) == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("given normals are kept at unit length; those of length zero count as missing") {
    const Mesh mesh = mesh_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 3 0 4\nvn 0 0 0\nf 1//1 2//2 3//1\n");
    CHECK(mesh.normals[0].x == doctest::Approx(0.6f));
    CHECK(mesh.normals[0].z == doctest::Approx(0.8f));
    CHECK(mesh.normals[1].z == 1);
}

TEST_CASE("vertices are shared where position, normal and texture coordinates agree") {
    const Mesh mesh = mesh_of(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\nvn 0 0 1\n"
        "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/5/1 4/4/1\nf 1 2 4\n");
    CHECK(mesh.triangles.size() == 3);
    CHECK(mesh.triangles[0].vertex[0] == mesh.triangles[1].vertex[0]);
    CHECK(mesh.triangles[0].vertex[2] != mesh.triangles[1].vertex[1]);
    REQUIRE(mesh.uvs.size() == mesh.positions.size());
    CHECK(mesh.uvs[mesh.triangles[1].vertex[1]].x == 0.5f);
    CHECK(mesh.uvs[mesh.triangles[2].vertex[1]].x == 0);  // corners without any get the origin
}

TEST_CASE("a mesh without texture coordinates has none") {
    CHECK(mesh_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1 1\nf 1 2 3\n").uvs.empty());
}

TEST_CASE("a fan of many faces around one vertex is read in reasonable time") {
    std::string obj = "v 0 1 0\n";
    constexpr int kSides = 20000;
    for (int i = 0; i < kSides; ++i) {
        const double a = 2 * std::numbers::pi * i / kSides;
        obj += fmt::format("v {:.9f} 0 {:.9f}\n", std::cos(a), -std::sin(a));
    }
    for (int i = 0; i < kSides; ++i) obj += fmt::format("f 1 {} {}\n", i + 2, (i + 1) % kSides + 2);
    const Mesh mesh = mesh_of(obj);
    CHECK(mesh.triangles.size() == kSides);
    CHECK(mesh.normals[0].y == doctest::Approx(1).epsilon(1e-5));
}
