#include <doctest/doctest.h>

#include <cmath>

#include "tests/renderer/support.h"

using namespace penumbra;
using namespace penumbra::tests;

namespace {

// A light that crosses the view, 0.1 m to the right a frame, in front of a resting camera at (0, 0,
// 4).
constexpr const char* kMovingLight = R"({
    "film": { "size": [128, 96] },
    "camera": { "eye": [0, 0, 4], "target": [0, 0, 0], "vfov": 40 },
    "lights": [ { "name": "l", "type": "rect", "center": [0, 0, 0], "u": [0.5, 0, 0], "v": [0, 0.5, 0],
                  "radiance": [1, 1, 1],
                  "keys": [ { "time": 0, "center": [0, 0, 0] }, { "time": 1, "center": [1, 0, 0] } ] } ],
    "animation": { "fps": 10, "frames": [1, 10] } })";

// The camera's eye passes its target at frame 4.
constexpr const char* kCameraThroughTarget = R"({
    "film": { "size": [32, 32] },
    "camera": { "eye": [0, 0, 3], "target": [0, 0, 0], "up": [0, 1, 0],
                "keys": [ { "time": 0, "eye": [0, 0, 3] }, { "time": 6, "eye": [0, 0, -3] } ] },
    "lights": [ { "name": "l", "type": "rect", "center": [0, 2, 0], "u": [1, 0, 0], "v": [0, 0, 1],
                  "radiance": [1, 1, 1] } ],
    "animation": { "fps": 1, "frames": [1, 1] } })";

}  // namespace

TEST_CASE("a visible light that moves has its own motion") {
    const Scene scene = read_scene_text(kMovingLight, {});
    const Film film = render(scene, {}, {}, 3);
    const double focal = 48 / std::tan(20 * 3.14159265358979 / 180);
    int lit = 0;
    double worst = 0;
    each_pixel(film, [&](int x, int y) {
        if (film.numbers(Aov::kBeauty, 3).at(x, y) == 0) return;
        ++lit;
        worst = std::max(worst, std::abs(film.numbers(Aov::kMotion, 0).at(x, y) - focal * 0.1 / 4));
        worst =
            std::max(worst, std::abs(static_cast<double>(film.numbers(Aov::kMotion, 1).at(x, y))));
    });
    CHECK(lit > 500);
    CHECK(worst < 1e-4);
}

TEST_CASE("a frame after one whose camera has no direction renders, without motion") {
    const Scene scene = read_scene_text(kCameraThroughTarget, {});
    CHECK_THROWS(render(scene, {}, {}, 4));
    const Film film = render(scene, {}, {}, 5);
    each_pixel(film, [&](int x, int y) { CHECK(film.numbers(Aov::kMotion, 0).at(x, y) == 0); });
}
