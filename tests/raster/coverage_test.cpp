#include <doctest/doctest.h>

#include "tests/raster/scenes.h"

using namespace penumbra;
using namespace penumbra::raster::testing;

TEST_CASE("a closed mesh covers every pixel as often from the front as from the back") {
    TestScene scene(200, 150, look_at({0, 1, 3.5f}, {0, 0, 0}, 200, 150));
    scene.add(torus(40, 20));
    const Coverage c = count(scene);
    int covered = 0, wrong = 0;
    for (int y = 0; y < 150; ++y)
        for (int x = 0; x < 200; ++x) {
            wrong += c.front.at(x, y) != c.back.at(x, y);
            covered += c.front.at(x, y) > 0;
        }
    CHECK(wrong == 0);
    CHECK(covered > 5000);
}
TEST_CASE("smoke render") {
    TestScene scene(200, 150, look_at({0, 1, 3.5f}, {0, 0, 0}, 200, 150));
    scene.add(torus(40, 20));
    const Frame f = render(scene);
    int hits=0;
    for (int y = 0; y < 150; ++y)
        for (int x = 0; x < 200; ++x) hits += f.instance.at(x,y)==0;
    CHECK(hits > 5000);
}
