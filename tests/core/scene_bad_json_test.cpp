#include <doctest/doctest.h>

#include "tests/core/scene_testing.h"

using namespace penumbra;
using penumbra::testing::scene_with;
using penumbra::testing::SceneFolder;

namespace {

struct BadScene {
    std::string content;
    std::string_view error;  // the whole line, but for "error: "
};

std::string with_light(std::string_view fields) {
    return scene_with(fmt::format(R"("lights": [{{{}}}])", fields));
}
std::string with_rect(std::string_view more) {
    return with_light(fmt::format(
        R"("type": "rect", "center": [0,3,0], "u": [1,0,0], "v": [0,0,1], "radiance": [1,1,1]{}{})",
        more.empty() ? "" : ", ", more));
}
std::string with_polygon(std::string_view vertices) {
    return with_light(
        fmt::format(R"("type": "polygon", "radiance": [1,1,1], "vertices": {})", vertices));
}
std::string with_camera(std::string_view camera) {
    return fmt::format(R"({{"camera": {{{}}}, "models": [{{"file": "triangle.obj"}}]}})", camera);
}
std::string with_model(std::string_view fields) {
    return fmt::format(R"({{"models": [{{"file": "triangle.obj", {}}}]}})", fields);
}

void check_all(const std::vector<BadScene>& scenes) {
    const SceneFolder folder;
    folder.write("triangle.obj", penumbra::testing::kTriangleObj);
    for (const auto& [content, error] : scenes) {
        CAPTURE(content);
        CHECK(folder.error_of_json(content) == error);
    }
}

}  // namespace

TEST_CASE("text that is no JSON is refused with its line and column") {
    const SceneFolder folder;
    const auto error = [&](std::string_view text) { return folder.error_of_json(text); };
    CHECK(error("{\n  \"film\": }")
              .starts_with("shot.json: line 2, column 11: syntax error while parsing value"));
    CHECK(error("").starts_with("shot.json: line 1, column 1: "));
    CHECK(error(R"({"film": {"size": [1, NaN]}})").starts_with("shot.json: line 1, column 23: "));
    CHECK(error("{} {}").starts_with("shot.json: line 1, column 4: "));
    CHECK(error(R"({"film": {"size": [1e999, 1]}})").find("number overflow") != std::string::npos);
    CHECK(error("{\"a\xff\": 1}").starts_with("shot.json: line 1, column 4: "));
    CHECK(error("{\"film\": {\"size\": [1, 2").starts_with("shot.json: line 1, column "));
}

TEST_CASE("a key that stands twice, and nesting without end, are refused with the place") {
    const SceneFolder folder;
    CHECK(folder.error_of_json(R"({"film": {"size": [1, 1], "size": [2, 2]}})") ==
          "shot.json: film: the key \"size\" stands twice");
    CHECK(folder.error_of_json(R"({"lights": [{}, {"u": 1, "u": 1}]})") ==
          "shot.json: lights[1]: the key \"u\" stands twice");
    const std::string deep(1000000, '[');
    CHECK(folder.error_of_json(deep).find("nested deeper than 32 levels") != std::string::npos);
}

TEST_CASE("unknown keys are refused, with the nearest known one suggested") {
    check_all({
        {R"({"flim": {}})",
         "shot.json: the document: unknown key \"flim\"; did you mean \"film\"?"},
        {with_rect(R"("radience": 1)"),
         "shot.json: lights[0]: unknown key \"radience\"; did you mean \"radiance\"?"},
        {with_rect(R"("zzzzzzzz": 1)"), "shot.json: lights[0]: unknown key \"zzzzzzzz\""},
        {with_model(R"("keys": [{"time": 0, "rotation": [0,0,0]}])"),
         "shot.json: models[0].keys[0]: unknown key \"rotation\"; did you mean \"rotate\"?"},
        {scene_with(R"("materials": {"a": {"basecolor": [0,0,0]}})"),
         "shot.json: materials.a: unknown key \"basecolor\"; did you mean \"base_color\"?"},
    });
}

TEST_CASE("values of the wrong type, count or range are refused with the place") {
    check_all({
        {with_rect(R"("name": 3)"), "shot.json: lights[0].name: expected a text, got 3"},
        {with_rect(R"("two_sided": 1)"),
         "shot.json: lights[0].two_sided: expected true or false, got 1"},
        {with_light(
             R"("type": "rect", "center": [0,3,0], "u": [1,0,0], "v": [0,0,1], "radiance": "white")"),
         "shot.json: lights[0].radiance: expected 3 numbers, got \"white\""},
        {with_light(
             R"("type": "rect", "center": [0,3], "u": [1,0,0], "v": [0,0,1], "radiance": [1,1,1])"),
         "shot.json: lights[0].center: expected 3 numbers, got [0, 3]"},
        {with_light(
             R"("type": "rect", "center": [0,3,0], "u": [1,0,0], "v": [0,0,1], "radiance": [1,-1,1])"),
         "shot.json: lights[0].radiance[1]: expected a number between 0 and 1e+12, got -1"},
        {scene_with(R"("film": {"size": [0, 5]})"),
         "shot.json: film.size[0]: expected a whole number between 1 and 16384, got 0"},
        {scene_with(R"("film": {"size": [1.5, 5]})"),
         "shot.json: film.size[0]: expected a whole number between 1 and 16384, got 1.5"},
        {scene_with(R"("film": {"size": [1, 2, 3]})"),
         "shot.json: film.size: expected width and height, got [1, 2, 3]"},
        {scene_with(R"("film": [1])"), "shot.json: film: expected an object, got [1]"},
        {scene_with(R"("lights": {})"), "shot.json: lights: expected a list, got an object"},
        {scene_with(R"("render": {"spp": 65})"),
         "shot.json: render.spp: expected a whole number between 1 and 64, got 65"},
        {scene_with(R"("animation": {"fps": 0})"),
         "shot.json: animation.fps: expected a number between 0.001 and 100000, got 0"},
        {scene_with(R"("animation": {"frames": [5, 4]})"),
         "shot.json: animation.frames[1]: expected a whole number between 5 and 1000000, got 4"},
        {scene_with(R"("materials": {"a": {"roughness": 1e300}})"),
         "shot.json: materials.a.roughness: expected a number between 0 and 1, got 1e+300"},
        {scene_with(R"("materials": {"a": {"ior": 1}})"),
         "shot.json: materials.a.ior: expected a number between 1.0001 and 100, got 1"},
        {"[1]", "shot.json: the document: expected an object, got [1]"},
    });
}

TEST_CASE("what a feature to come would need is refused as not supported yet") {
    check_all({
        {with_light(R"("type": "sphere", "center": [0,0,0], "radius": 1, "radiance": [1,1,1])"),
         "shot.json: lights[0].type: \"sphere\" is not supported yet; expected \"rect\" or "
         "\"polygon\""},
        {with_light(R"("type": "rectangle")"),
         "shot.json: lights[0].type: expected \"rect\" or \"polygon\", got \"rectangle\""},
        {with_light(R"("type": "rekt")"),
         "shot.json: lights[0].type: expected \"rect\" or \"polygon\", got \"rekt\"; did you mean "
         "\"rect\"?"},
        {with_rect(R"("texture": "a.png")"),
         "shot.json: lights[0]: \"texture\" is not supported yet"},
        {scene_with(R"("environment": {"file": "sky.hdr"})"),
         "shot.json: environment: \"file\" is not supported yet; expected \"radiance\", a constant "
         "colour"},
        {R"({"models": [{"file": "a.gltf"}]})",
         "shot.json: models[0].file: expected a model in an .obj file, got \"a.gltf\""},
    });
}

TEST_CASE("lights without area, bent, or not convex are refused") {
    check_all({
        {with_light(
             R"("type": "rect", "center": [0,3,0], "u": [1,0,0], "v": [2,0,0], "radiance": [1,1,1])"),
         "shot.json: lights[0]: the light has no area"},
        {with_polygon("[[0,0,0],[1,0,0],[2,0,0]]"), "shot.json: lights[0]: the light has no area"},
        {with_polygon("[[0,0,0],[1,0,0]]"),
         "shot.json: lights[0].vertices: expected 3 to 8 vertices, got 2"},
        {with_polygon("[[0,0,0],[1,0,0],[1,1,0.5],[0,1,0]]"),
         "shot.json: lights[0]: vertex 1 is off the plane of the others"},
        {with_polygon("[[0,0,0],[2,0,0],[0.5,0.5,0],[0,2,0]]"),
         "shot.json: lights[0]: the polygon is not convex at vertex 2"},
        {with_polygon("[[0,0,0],[1,0,0],[1,0,0],[0,1,0]]"),
         "shot.json: lights[0]: vertices 1 and 2 coincide"},
        {with_polygon("[[0,1,0],[-0.59,-0.81,0],[0.95,0.31,0],[-0.95,0.31,0],[0.59,-0.81,0]]"),
         "shot.json: lights[0]: the polygon crosses itself"},
        {with_rect(R"("keys": [{"time": 0}, {"time": 1, "u": [0,0,0]}])"),
         "shot.json: lights[0]: at 1 s the light has no area"},
        {scene_with(R"("animation": {"fps": 2, "frames": [1, 9]}, "lights": [{"type": "rect",
"center": [0,3,0], "u": [1,0,0], "v": [0,0,1], "radiance": [1,1,1],
"keys": [{"time": 0, "u": [1,0,0]}, {"time": 2, "u": [-1,0,0]}]}])"),
         "shot.json: lights[0]: at frame 3 the light has no area"},
    });
}

TEST_CASE("cameras without a direction are refused, at their keys and between them") {
    check_all({
        {with_camera(R"("eye": [1,2,3], "target": [1,2,3])"),
         "shot.json: camera: \"eye\" and \"target\" coincide"},
        {with_camera(R"("eye": [0,5,0], "target": [0,0,0])"),
         "shot.json: camera: \"up\" is parallel to the view direction"},
        {with_camera(R"("eye": [0,0,5], "target": [0,0,0], "up": [0,0,0])"),
         "shot.json: camera: \"up\" has no length"},
        {with_camera(R"("eye": [0,0,5])"), "shot.json: camera: \"target\" is missing"},
        {with_camera(R"("target": [0,0,5], "keys": [{"time": 0}, {"time": 1, "eye": [0,0,0]}])"),
         "shot.json: camera: \"eye\" is missing"},
        {with_camera(R"("eye": [0,0,5], "target": [0,0,0], "vfov": 180)"),
         "shot.json: camera.vfov: expected a number between 0.01 and 179, got 180"},
        {with_camera(R"("eye": [0,0,5], "target": [0,0,0], "near": 0)"),
         "shot.json: camera.near: expected a number between 1e-09 and 1e+06, got 0"},
        {with_camera(R"("eye": [0,0,5], "target": [0,0,0], "keys": [{"time": 1, "eye": [0,0,0]}])"),
         "shot.json: camera: at 1 s \"eye\" and \"target\" coincide"},
        {R"({"film": {}})",
         "shot.json: the document: \"camera\" is missing, and there is no model"},
    });
}

TEST_CASE("keys out of order, turns of half a circle and scales through zero are refused") {
    check_all({
        {with_model(R"("keys": [{"time": 1}, {"time": 1}])"),
         "shot.json: models[0].keys[1].time: expected a time after 1, got 1"},
        {with_model(R"("keys": [])"), "shot.json: models[0].keys: expected at least one key"},
        {with_model(R"("keys": [{"translate": [0,0,0]}])"),
         "shot.json: models[0].keys[0]: \"time\" is missing"},
        {with_model(
             R"("keys": [{"time": 0, "rotate": [0,0,0]}, {"time": 2, "rotate": [0,180,0]}])"),
         "shot.json: models[0]: the rotations at 0 s and 2 s are 180 degrees or more apart: insert "
         "a key between them"},
        {with_model(
             R"("keys": [{"time": 0, "rotate": [0,0,0]}, {"time": 2, "rotate": [0,350,0]}])"),
         "shot.json: models[0]: the rotations at 0 s and 2 s are 180 degrees or more apart: insert "
         "a key between them"},
        {with_model(R"("scale": 0)"),
         "shot.json: models[0]: scale: expected numbers of at least 1e-06 or at most -1e-06"},
        {with_model(R"("scale": [1, 1])"),
         "shot.json: models[0].scale: expected 3 numbers, got [1, 1]"},
        {with_model(R"("keys": [{"time": 0, "scale": 1}, {"time": 2, "scale": -1}])"),
         "shot.json: models[0]: scale: changes its sign before 2 s"},
    });
}

TEST_CASE("names that stand twice or stand for nothing are refused") {
    check_all({
        {R"({"models": [{"file": "triangle.obj", "name": "a"}, {"file": "triangle.obj", "name": "a"}]})",
         "shot.json: models[1].name: \"a\" is the name of another model too"},
        {scene_with(R"("lights": [
{"type": "rect", "name": "key", "center": [0,3,0], "u": [1,0,0], "v": [0,0,1], "radiance": [1,1,1]},
{"type": "rect", "name": "key", "center": [0,3,0], "u": [1,0,0], "v": [0,0,1], "radiance": [1,1,1]}])"),
         "shot.json: lights[1].name: \"key\" is the name of another light too"},
        {R"({"materials": {"oak": {}}, "models": [{"file": "triangle.obj", "material": "aok"}]})",
         "shot.json: models[0].material: no material \"aok\" in \"materials\"; did you mean "
         "\"oak\"?"},
        {R"({"models": [{"file": "missing.obj"}]})",
         "shot.json: models[0].file: no such file: \"missing.obj\""},
        {R"({"models": [{"name": "x"}]})", "shot.json: models[0]: \"file\" is missing"},
        {scene_with(R"("materials": {"a": {"base_color_map": "oak.png"}})"),
         "shot.json: materials.a.base_color_map: no such file: \"oak.png\""},
    });
}

TEST_CASE("files that are missing, folders or of another kind are refused") {
    const SceneFolder folder;
    CHECK(folder.error_of("none.json") == "none.json: no such file");
    CHECK(folder.error_of("none.obj") == "none.obj: no such file");
    CHECK(folder.error_of("scene.blend") ==
          "scene.blend: expected a scene (.json) or a model (.obj)");
    std::filesystem::create_directory(folder / "folder.json");
    CHECK(folder.error_of("folder.json") == "folder.json: is a folder, expected a file");
    std::filesystem::create_symlink("/dev/zero", folder / "zero.json");
    std::filesystem::create_symlink("/dev/zero", folder / "zero.obj");
    CHECK(folder.error_of("zero.json") == "zero.json: is a device, expected a file");
    CHECK(folder.error_of("zero.obj") == "zero.obj: is a device, expected a file");
    folder.write("long.json", "{");
    std::filesystem::resize_file(folder / "long.json", std::uintmax_t{1} << 40);
    CHECK(folder.error_of("long.json") ==
          "long.json: 1099511627776 bytes long, expected at most 67108864");
}

TEST_CASE("messages stay on one line, whatever the file holds") {
    const SceneFolder folder;
    const std::string error = folder.error_of_json(
        R"({"a\nb\u0007cccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccc": 1})");
    CHECK(error.find('\n') == std::string::npos);
    CHECK(error.size() < 200);
}
