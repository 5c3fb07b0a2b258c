#include <doctest/doctest.h>

#include <cmath>

#include "core/scene/read_scene.h"
#include "core/scene/scene_view.h"

using namespace penumbra;

// Scenes from elsewhere, beside the source folder; skipped where they are not.

namespace {

namespace fs = std::filesystem;

fs::path assets() {
    return fs::path(PENUMBRA_SOURCE_DIR).parent_path() / "shared" / "assets";
}

bool is_finite(const Vec3f& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_mesh(const Mesh& mesh, std::size_t materials) {
    const std::size_t vertices = mesh.positions.size();
    bool is_right = mesh.normals.size() == vertices &&
                    (mesh.uvs.empty() || mesh.uvs.size() == vertices) &&
                    mesh.triangle_slots.size() == mesh.triangles.size();
    for (std::size_t i = 0; is_right && i < vertices; ++i)
        is_right = is_finite(mesh.positions[i]) && std::fabs(length(mesh.normals[i]) - 1) < 1e-5f;
    for (const Triangle& t : mesh.triangles)
        for (const auto v : t.vertex) is_right = is_right && v < vertices;
    for (const auto slot : mesh.triangle_slots) is_right = is_right && slot < materials;
    CHECK(is_right);
}

struct Expected {
    const char* file;
    std::size_t triangles, dropped, materials, emitters;
};

}  // namespace

TEST_CASE("real scenes are read whole") {
    const std::vector<Expected> scenes{{"sponza-dabrovic/sponza-dabrovic.obj", 66445, 0, 19, 0},
                                       {"hotel-room/hotel-room.obj", 99029, 0, 11, 0},
                                       {"cornell-box/CornellBox-Original.obj", 36, 0, 8, 1},
                                       {"coffee-maker/coffee-maker.obj", 234764, 507, 8, 3},
                                       {"dx-dwarf/dwarf.obj", 5270, 0, 9, 0},
                                       {"statues/cgal-armadillo.obj", 52000, 0, 1, 0},
                                       {"statues/cgal-elephant.obj", 88928, 0, 1, 0}};
    for (const Expected& expected : scenes) {
        const fs::path file = assets() / expected.file;
        if (!fs::exists(file)) {
            MESSAGE("skipped, not there: " << file.string());
            continue;
        }
        CAPTURE(expected.file);
        const Scene scene = read_scene(file);
        REQUIRE(scene.meshes.size() == 1);
        CHECK(scene.meshes[0].triangles.size() == expected.triangles);
        CHECK(scene.meshes[0].dropped_triangles == expected.dropped);
        CHECK(scene.materials.size() == expected.materials);
        CHECK(scene.emitters.size() == expected.emitters);
        CHECK(scene.lights.size() == (expected.emitters > 0 ? 0 : 1));
        check_mesh(scene.meshes[0], scene.models[0].materials.size());
        SceneView view;
        evaluate(scene, {}, {192, 108}, view);
        CHECK(view.lights.size() == scene.lights.size() + scene.emitters.size());
    }
}

TEST_CASE("the Cornell box's ceiling light is one rectangle that shines down") {
    const fs::path file = assets() / "cornell-box/CornellBox-Original.obj";
    if (!fs::exists(file)) {
        MESSAGE("skipped, not there: " << file.string());
        return;
    }
    SceneView view;
    const Scene scene = read_scene(file);
    evaluate(scene, {}, {100, 100}, view);
    REQUIRE(view.lights.size() == 1);
    CHECK(view.lights.polygons[0].shape.count == 4);
    CHECK(view.lights.polygons[0].shape.normal.y < -0.999f);
    CHECK(view.lights.polygons[0].shape.area == doctest::Approx(0.47 * 0.38).epsilon(0.02));
}
