#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/scene/scene_view.h"
#include "tests/core/scene_testing.h"

using namespace penumbra;

// Damaged files: whatever is in them, reading ends with a checked scene or with one InputError.

namespace {

constexpr std::string_view kJson = R"({
"film": {"size": [64, 48]},
"camera": {"eye": [0, 1, 4], "target": [0, 0.5, 0], "up": [0, 1, 0], "vfov": 45,
  "keys": [{"time": 0, "eye": [0, 1, 4]}, {"time": 2, "eye": [1, 1, 4]}]},
"models": [{"name": "a", "file": "m.obj", "scale": 0.5, "rotate": [0, 90, 0], "translate": [1, 0, 0],
  "keys": [{"time": 0}, {"time": 2, "translate": [2, 0, 0], "rotate": [0, 180, 0]}]}],
"materials": {"lamp": {"base_color": [0.5, 0.5, 0.5], "roughness": 0.2, "ior": 1.5}},
"lights": [{"name": "key", "type": "rect", "center": [0, 3, 0], "u": [0.5, 0, 0], "v": [0, 0, 0.5],
  "radiance": [10, 10, 10]}, {"type": "polygon", "vertices": [[0,1,0],[1,1,0],[0,1,1]], "radiance": [1,1,1]}],
"environment": {"radiance": [0, 0, 1]}, "animation": {"fps": 24, "frames": [1, 4]}, "render": {"spp": 1}
})";

constexpr std::string_view kObj = R"(mtllib m.mtl
v 0 0 0
v 1.5 0 0
v 1.5 1.25e0 0
v 0 1 .5
v -1 -2 -3
vt 0 0
vt 1 0
vt 1 1
vn 0 0 1
usemtl lamp
f 1/1/1 2/2/1 3/3/1 4/1/1
f -5//-1 -4//-1 -1//-1
f 1 2 3 4 5
)";

constexpr std::string_view kMtl = R"(newmtl lamp
Kd 0.5 0.5 0.5
Ke 1 2 3
Ns 30
Pr 0.5
Pm 0
Ni 1.5
d 1
)";

// SplitMix64.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::size_t below(std::size_t limit) {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return static_cast<std::size_t>((z ^ (z >> 31)) % limit);
    }

  private:
    std::uint64_t state_;
};

std::string damaged(std::string_view original, Random& random) {
    static constexpr std::string_view kPieces[] = {
        "0",     "-",    "1e39", "nan", "9999999999", "/",  "//", "[", "{",    "\"", "\\\n",
        "1e999", "null", "\r",   ",",   "-7",         "f ", "v ", "#", "true", "e",  "usemtl x\n"};
    std::string text(original);
    const std::size_t count = 1 + random.below(4);
    for (std::size_t i = 0; i < count && !text.empty(); ++i) {
        const std::size_t at = random.below(text.size());
        const std::size_t length = random.below(std::min<std::size_t>(12, text.size() - at) + 1);
        switch (random.below(5)) {
            case 0:
                text[at] = static_cast<char>(random.below(256));
                break;
            case 1:
                text.erase(at, length);
                break;
            case 2:
                text.insert(at, text.substr(random.below(text.size()), length));
                break;
            case 3:
                text.insert(at, kPieces[random.below(std::size(kPieces))]);
                break;
            default:
                text.resize(at + 1);
                break;
        }
    }
    return text;
}

void read_and_evaluate(const std::string& json, const VirtualFiles& files) {
    try {
        const Scene scene = read_scene_text(json, files);
        SceneView view;
        evaluate(scene, times_of_frame(scene.animation, 2), {64, 48}, view);
        for (const Instance& instance : view.instances)
            for (const Vec3f& p : instance.positions) REQUIRE(std::isfinite(p.x + p.y + p.z));
    } catch (const InputError& error) {
        REQUIRE(std::string_view(error.what()).find('\n') == std::string_view::npos);
    }
}

}  // namespace

TEST_CASE("the files that are damaged below are good") {
    const Scene scene =
        read_scene_text(kJson, {{"m.obj", std::string(kObj)}, {"m.mtl", std::string(kMtl)}});
    CHECK(scene.meshes[0].triangles.size() == 6);
    CHECK(scene.lights.size() == 2);
    CHECK(scene.emitters.size() >= 2);
}

TEST_CASE("damaged scene files, models and materials give a scene or one error") {
    Random random(7);
    const VirtualFiles whole{{"m.obj", std::string(kObj)}, {"m.mtl", std::string(kMtl)}};
    for (int i = 0; i < 1500; ++i) {
        CAPTURE(i);
        read_and_evaluate(damaged(kJson, random), whole);
        VirtualFiles files = whole;
        files["m.obj"] = damaged(kObj, random);
        read_and_evaluate(std::string(kJson), files);
        files = whole;
        files["m.mtl"] = damaged(kMtl, random);
        read_and_evaluate(std::string(kJson), files);
    }
}
