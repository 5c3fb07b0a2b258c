#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/bsdf/ggx.h"
#include "tests/core/scene_testing.h"

using namespace penumbra;
using penumbra::testing::kTriangleObj;
using penumbra::testing::SceneFolder;

namespace {

constexpr std::string_view kTexturedObj =
    "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 "
    "3/3\n";

// A Radiance picture of one pixel: the plainest format that the texture reader takes.
std::string picture(std::array<std::uint8_t, 4> rgbe = {128, 64, 32, 128}) {
    std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n";
    for (const std::uint8_t byte : rgbe) text += static_cast<char>(byte);
    return text;
}

Scene read(const SceneFolder& folder, std::string_view mtl) {
    folder.write("model.mtl", mtl);
    return read_scene(folder.write("model.obj", kTexturedObj));
}

Material material_of(std::string_view statements) {
    const SceneFolder folder;
    folder.write("map.hdr", picture());
    const Scene scene = read(folder, "newmtl m\n" + std::string(statements));
    return scene.materials.at(0);
}

float red_of(const Scene& scene, int texture) {
    const Texture& t = scene.textures.at(static_cast<std::size_t>(texture));
    return texel(t, 0, 0, 0).r;
}

}  // namespace

TEST_CASE("an MTL's roughness is Pr, else from Ns, else one half") {
    CHECK(material_of("Kd 1 1 1\n").roughness == 0.5f);
    CHECK(material_of("Pr 0.3\nNs 10\n").roughness == 0.3f);
    CHECK(material_of("Pr 0\n").roughness == kMinimumRoughness);
    const float r = material_of("Ns 30\n").roughness;
    CHECK(r * r == doctest::Approx(std::sqrt(2.0 / 32)));
    CHECK(material_of("Ns 0\n").roughness == 1);
    CHECK(material_of("map_Pr map.hdr\n").roughness == 1);
}

TEST_CASE("statements that an MTL leaves out take our defaults, not the loader's") {
    const Material plain = material_of("illum 2\n");
    CHECK(plain.base_color.x == 0.5f);
    CHECK(plain.metallic == 0);
    CHECK(plain.ior == 1.5f);
    CHECK(material_of("Ni 1\n").ior == 1.5f);
    CHECK(material_of("Ni 0.5\n").ior == 1.5f);
    CHECK(material_of("Ni 1.33\n").ior == 1.33f);
    CHECK(material_of("map_Kd map.hdr\n").base_color.y == 1);
    CHECK(material_of("Kd 0.25 0.5 0.75\nmap_Kd map.hdr\n").base_color.z == 0.75f);
    CHECK(material_of("map_Pm map.hdr\n").metallic == 1);
    CHECK(material_of("Pm 0.5\nmap_Pm map.hdr\n").metallic == 0.5f);
    CHECK(material_of("Kd 0.2\n").base_color.z == 0.2f);
    CHECK(material_of("Kd 1.00001 2 0 # bright\n").base_color.y == 1);
}

TEST_CASE("a second material does not inherit the first one's statements") {
    const SceneFolder folder;
    folder.write("model.mtl", "newmtl a\nKd 0 0 1\nPr 0.1\nPm 1\n\nnewmtl m\nKs 1 1 1\n");
    const Scene scene = read_scene(folder.write("model.obj", kTexturedObj));
    CHECK(scene.materials[0].name == "m");
    CHECK(scene.materials[0].base_color.x == 0.5f);
    CHECK(scene.materials[0].roughness == 0.5f);
    CHECK(scene.materials[0].metallic == 0);
}

TEST_CASE("each map of an MTL goes to its place") {
    const Material m = material_of(
        "map_Kd map.hdr\nmap_Pr map.hdr\nmap_Pm map.hdr\nmap_d map.hdr\nnorm map.hdr\n");
    CHECK(m.base_color_map >= 0);
    CHECK(m.roughness_map >= 0);
    CHECK(m.metallic_map == m.roughness_map);  // the same file as the same kind is loaded once
    CHECK(m.opacity_map >= 0);
    CHECK(m.normal_map >= 0);
    CHECK(m.normal_map != m.base_color_map);
}

TEST_CASE("a bump map is a height map where its channels are equal, else a normal map") {
    const SceneFolder folder;
    folder.write("grey.hdr", picture({64, 64, 64, 128}));
    folder.write("normal.hdr", picture({64, 64, 128, 128}));
    // A constant height is flat: the normal (0.5, 0.5, 1) whatever the grey.
    const Scene height = read(folder, "newmtl m\nmap_Bump -bm 2 grey.hdr\n");
    const Texel flat = texel(height.textures[0], 0, 0, 0);
    CHECK(flat.r == doctest::Approx(0.5).epsilon(1e-3));
    CHECK(flat.b == doctest::Approx(1).epsilon(1e-3));
    for (const std::string_view statement : {"bump", "map_bump", "map_Bump", "norm"})
        CHECK(read(folder, fmt::format("newmtl m\n{} normal.hdr\n", statement))
                  .materials[0]
                  .normal_map == 0);
}

TEST_CASE("file names of other systems, with spaces and of other case are found") {
    const SceneFolder folder;
    folder.write("textures/Old Oak.HDR", picture());
    for (const std::string_view name :
         {"textures/Old Oak.HDR", "textures\\Old Oak.HDR", "TEXTURES\\old oak.hdr",
          "C:\\work\\project\\textures\\Old Oak.HDR", "C:\\textures\\old oak.hdr",
          "./textures/../textures/Old Oak.HDR", "/textures/Old Oak.HDR",
          "-bm 1 textures/Old Oak.HDR"}) {
        CAPTURE(name);
        if (name.find("work") != name.npos) folder.write("Old Oak.HDR", picture());
        const Scene scene = read(folder, fmt::format("newmtl m\r\nmap_Kd {}  \r\n", name));
        CHECK(red_of(scene, 0) == doctest::Approx(0.5).epsilon(1e-3));
    }
}

TEST_CASE("material libraries with spaces in their names are found; missing ones only warn") {
    const SceneFolder folder;
    folder.write("my materials.mtl", "newmtl red\nKd 1 0 0\n");
    const std::string body = "usemtl red\n" + std::string(kTriangleObj);
    const Scene found = read_scene(folder.write("a.obj", "mtllib my materials.mtl\n" + body));
    CHECK(found.materials[0].base_color.y == 0);
    const Scene missing = read_scene(folder.write("b.obj", "mtllib none.mtl\n" + body));
    CHECK(missing.materials[0].name == "default");
    REQUIRE(missing.warnings.size() == 2);
    CHECK(missing.warnings[0].find("the material library \"none.mtl\" is missing") !=
          std::string::npos);
    CHECK(missing.warnings[1] == "b.obj: the material \"red\" is not defined; \"default\" is used");
}

TEST_CASE("bad MTL lines and missing textures are refused with the line") {
    const SceneFolder folder;
    folder.write("model.obj", kTexturedObj);
    const auto error = [&](std::string_view mtl) {
        folder.write("model.mtl", mtl);
        return folder.error_of("model.obj");
    };
    CHECK(error("newmtl m\nKd 1 nan 0\n") ==
          "model.mtl: line 2: Kd: expected a number, got \"nan\"");
    CHECK(error("newmtl m\nKd 1 0\n") ==
          "model.mtl: line 2: Kd: expected 3 numbers, got 2 numbers");
    CHECK(error("newmtl m\nPr\n") == "model.mtl: line 2: Pr: expected 1 number, got 0 numbers");
    CHECK(error("newmtl m\n\nPr 1.5\n") ==
          "model.mtl: line 3: Pr: expected a number between 0 and 1, got 1.5");
    CHECK(error("newmtl m\nKe 1 -1 0\n") ==
          "model.mtl: line 2: Ke: expected a number between 0 and 1e+12, got -1");
    CHECK(error("newmtl m\nNs 1e40\n") ==
          "model.mtl: line 2: Ns: expected a number between 0 and 1e+09, got inf");
    CHECK(error("Kd 1 1 1\n") == "model.mtl: line 1: Kd before the first newmtl");
    CHECK(error("newmtl\n") == "model.mtl: line 1: newmtl without a name");
    CHECK(error("newmtl m\nmap_Kd\n") == "model.mtl: line 2: map_Kd without a file name");
    CHECK(error("newmtl m\nmap_Kd none.png\n") ==
          "model.mtl: line 2: map_Kd: no such file: \"none.png\"");
    CHECK(error("newmtl m\nmap_Kd -s 1 1 1 none.png\n") ==
          "model.mtl: line 2: map_Kd: no such file: \"none.png\"");
    CHECK(error("newmtl m\nmap_Kd -s 1 1 1\n") == "model.mtl: line 2: a map without a file name");
    folder.write("broken.png", "\x89PNG\r\n\x1a\n");
    CHECK(error("newmtl m\nmap_Kd broken.png\n").starts_with("broken.png: "));
}

TEST_CASE("a missing texture is an error only where it is used") {
    const SceneFolder folder;
    CHECK_NOTHROW(static_cast<void>(read(folder, "newmtl m\nnewmtl unused\nmap_Kd none.png\n")));
    folder.write("model.mtl", "newmtl m\nmap_Kd none.png\n");
    const Scene scene = read_scene(folder.write("shot.json", R"({
        "models": [{"file": "model.obj"}], "materials": {"m": {"base_color_map": null}}})"));
    CHECK(scene.materials[0].base_color_map == kNoTexture);
}

TEST_CASE("what an MTL asks for and is not drawn is warned of once") {
    const SceneFolder folder;
    folder.write("map.hdr", picture());
    const Scene glass = read(folder, "newmtl m\nd 0.5\nnewmtl n\nTr 0.5\n");
    REQUIRE(glass.warnings.size() == 1);
    CHECK(glass.warnings[0].find("model.mtl: 2 transparent materials (m, ...) drawn opaque") !=
          std::string::npos);
    CHECK(read(folder, "newmtl m\nd 0.5\nmap_d map.hdr\n").warnings.empty());
    const Scene scaled = read(folder, "newmtl m\nmap_Kd -s 2 2 2 map.hdr\nmap_Pr -s 2 2 map.hdr\n");
    REQUIRE(scaled.warnings.size() == 1);
    CHECK(scaled.warnings[0].find("the texture option -s is ignored") != std::string::npos);
}

TEST_CASE("materials of the scene file lie over those of the MTL by name, field by field") {
    const SceneFolder folder;
    folder.write("map.hdr", picture());
    folder.write("other.hdr", picture({64, 64, 64, 128}));
    folder.write("model.mtl",
                 "newmtl m\nKd 0.25 0.25 0.25\nPr 0.7\nmap_Kd map.hdr\nmap_Pr map.hdr\n");
    folder.write("model.obj", kTexturedObj);
    const Scene scene = read_scene(folder.write("shot.json", R"({
        "models": [{"file": "model.obj"}],
        "materials": {"m": {"roughness": 0.01, "base_color_map": "other.hdr", "roughness_map": null}}})"));
    const Material& m = scene.materials[0];
    CHECK(m.base_color.x == 0.25f);
    CHECK(m.roughness == kMinimumRoughness);
    CHECK(m.roughness_map == kNoTexture);
    CHECK(red_of(scene, m.base_color_map) == doctest::Approx(0.25).epsilon(1e-3));
}

TEST_CASE("faces without a material take the model's, else default") {
    const SceneFolder folder;
    folder.write("triangle.obj", kTriangleObj);
    const Scene scene = read_scene(folder.write("shot.json", R"({
        "models": [{"name": "a", "file": "triangle.obj", "material": "oak"},
                   {"name": "b", "file": "triangle.obj"}],
        "materials": {"oak": {"metallic": 1}, "default": {"roughness": 0.9}, "unused": {}}})"));
    REQUIRE(scene.meshes.size() == 1);
    CHECK(scene.materials[scene.models[0].materials[0]].metallic == 1);
    CHECK(scene.materials[scene.models[1].materials[0]].roughness == 0.9f);
    REQUIRE(scene.warnings.size() == 2);
    CHECK(scene.warnings[0] == "materials.unused: no model uses a material of this name");
    CHECK(scene.warnings[1].starts_with("there is no light"));
}

TEST_CASE("a material without an MTL may be defined in the scene file alone") {
    const SceneFolder folder;
    folder.write("model.obj", "usemtl oak\n" + std::string(kTriangleObj));
    const Scene scene = read_scene(folder.write("shot.json", R"({
        "models": [{"file": "model.obj"}], "materials": {"oak": {"roughness": 0.25}}})"));
    CHECK(scene.materials[0].name == "oak");
    CHECK(scene.materials[0].roughness == 0.25f);
}
