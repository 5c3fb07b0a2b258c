#include <doctest/doctest.h>

#include "apps/renderer/builtin_scene.h"
#include "tests/renderer/support.h"

// What else the image does not depend on; threads, tiles and widths: reproducibility_test.cpp.

using namespace penumbra;
using namespace penumbra::tests;

namespace {

const ImageSettings kSmall{.width = 200, .height = 120, .samples_per_pixel = 2};

const Scene& builtin() {
    static const Scene kScene = renderer::read_builtin_scene();
    return kScene;
}

}  // namespace

TEST_CASE("a frame does not depend on the frames rendered before it") {
    const std::uint64_t expected = digest(render(builtin(), kSmall, {}, 30));
    renderer::Renderer renderer(builtin(), kSmall, {});
    Film film;
    for (const int frame : {1, 48, 29, 30}) renderer.render(frame, all_aovs(), film);
    CHECK(digest(film) == expected);
}

TEST_CASE("another seed and another frame give other samples") {
    ImageSettings reseeded = kSmall;
    reseeded.seed = 1;
    CHECK(digest(render(builtin(), kSmall)) != digest(render(builtin(), reseeded)));
    CHECK(digest(render(builtin(), kSmall, {}, 1)) != digest(render(builtin(), kSmall, {}, 2)));
}

TEST_CASE("a crop is bit-equal to that cut-out of the full frame") {
    const ImageSettings size{.width = 420, .height = 300, .samples_per_pixel = 1};
    const Film full = render(builtin(), size);
    for (const PixelRect crop : {PixelRect{0, 0, 1, 1}, PixelRect{131, 70, 300, 200},
                                 PixelRect{410, 290, 420, 300}, PixelRect{64, 64, 128, 128}}) {
        ImageSettings cropped = size;
        cropped.crop = crop;
        Film cut_out = render(builtin(), cropped);
        int differing = 0;
        each_pixel(cut_out, [&](int x, int y) {
            const int fx = x + cut_out.window.x0 - full.window.x0;
            const int fy = y + cut_out.window.y0 - full.window.y0;
            for (std::size_t c = 0; c < 3; ++c) {
                differing += cut_out.beauty[c].at(x, y) != full.beauty[c].at(fx, fy);
                differing += cut_out.total().ratio[c].at(x, y) != full.total().ratio[c].at(fx, fy);
            }
            differing += cut_out.total().noise.at(x, y) != full.total().noise.at(fx, fy);
            differing += cut_out.ids(Aov::kId, 1).at(x, y) != full.ids(Aov::kId, 1).at(fx, fy);
        });
        CHECK(differing == 0);
    }
}
