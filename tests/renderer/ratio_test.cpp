#include <doctest/doctest.h>

#include <cmath>

#include "apps/renderer/builtin_scene.h"
#include "tests/renderer/support.h"

using namespace penumbra;
using namespace penumbra::tests;

namespace {

const ImageSettings kSmall{.width = 240, .height = 136, .samples_per_pixel = 1};

std::vector<Scene> all_scenes() {
    std::vector<Scene> scenes;
    scenes.push_back(renderer::read_builtin_scene());
    for (const char* name :
         {"cornell-box/cornell-box.json", "cubes/cubes-small.json", "cubes/cubes-medium.json",
          "cubes/cubes-large.json", "textured-wall/textured-wall.json", "teapot/teapot.json"})
        scenes.push_back(read_scene(data_scene(name)));
    return scenes;
}

int pixels_unlike_emission_plus_u(const Film& film) {
    int unlike = 0;
    each_pixel(film, [&](int x, int y) {
        for (std::size_t c = 0; c < 3; ++c)
            unlike += film.beauty[c].at(x, y) !=
                      film.emission[c].at(x, y) + film.total().unshadowed[c].at(x, y);
    });
    return unlike;
}

}  // namespace

TEST_CASE("with visibility 1 the denoised frame is emission + U to the last bit, on every scene") {
    for (const Scene& scene : all_scenes()) {
        CAPTURE(scene.file.string());
        const ExecutionSettings visible{.visibility = shadow::Visibility::kForcedToOne};
        CHECK(pixels_unlike_emission_plus_u(render(scene, kSmall, visible)) == 0);
        ImageSettings jittered = kSmall;
        jittered.passes = 3;
        CHECK(pixels_unlike_emission_plus_u(render(scene, jittered, visible)) == 0);
    }
}

TEST_CASE("every pixel is finite, W lies in [0, 1] and beauty between emission and emission + U") {
    for (const Scene& scene : all_scenes()) {
        CAPTURE(scene.file.string());
        const Film film = render(scene, kSmall);
        int wrong = 0;
        int not_finite = 0;
        each_pixel(film, [&](int x, int y) {
            for (std::size_t c = 0; c < 3; ++c) {
                const float w = film.total().ratio[c].at(x, y);
                wrong += !(w >= 0 && w <= 1);
                const float low = film.emission[c].at(x, y);
                const float high = low + film.total().unshadowed[c].at(x, y);
                const float beauty = film.beauty[c].at(x, y);
                wrong += !(beauty >= low && beauty <= high);
            }
        });
        each_plane(film, [&](const char*, const auto& plane) {
            each_pixel(film, [&](int x, int y) {
                not_finite += !std::isfinite(static_cast<double>(plane.at(x, y)));
            });
        });
        CHECK(wrong == 0);
        CHECK(not_finite == 0);
    }
}

TEST_CASE("the ratio estimator converges to the stochastic one as rays are added") {
    const Scene scene = read_scene(data_scene("cubes/cubes-medium.json"));
    ImageSettings settings{
        .width = 96, .height = 64, .denoise = renderer::Denoise::kNone, .samples_per_pixel = 64};
    const Film ratio = render(scene, settings);
    settings.method = renderer::Method::kStochastic;
    settings.seed = 77;
    const Film stochastic = render(scene, settings);
    double difference = 0;
    double total = 0;
    each_pixel(ratio, [&](int x, int y) {
        difference += std::abs(ratio.beauty[1].at(x, y) - stochastic.beauty[1].at(x, y));
        total += stochastic.beauty[1].at(x, y);
    });
    CHECK(difference / total < 0.02);  // noise of 64 samples and the LTC's error
}

TEST_CASE("the denoised frame of one ray lies nearer to the converged one than the raw frame") {
    const Scene scene = read_scene(data_scene("cubes/cubes-large.json"));
    ImageSettings settings{
        .width = 192, .height = 108, .denoise = renderer::Denoise::kNone, .samples_per_pixel = 64};
    const Film converged = render(scene, settings);
    settings.samples_per_pixel = 1;
    const auto error = [&](const Film& film) {
        double sum = 0;
        each_pixel(film, [&](int x, int y) {
            const double d = film.beauty[1].at(x, y) - converged.beauty[1].at(x, y);
            sum += d * d;
        });
        return sum;
    };
    const double raw = error(render(scene, settings));
    settings.denoise = renderer::Denoise::kNoiseDriven;
    CHECK(error(render(scene, settings)) < 0.5 * raw);
}

TEST_CASE("jittered passes blend coverage at silhouettes and leave the ids of the first pass") {
    const Scene scene = read_scene(data_scene("teapot/teapot.json"));
    ImageSettings settings = kSmall;
    const Film single = render(scene, settings);
    settings.passes = 8;
    const Film blended = render(scene, settings);
    int same_ids = 0;
    int pixels = 0;
    each_pixel(blended, [&](int x, int y) {
        ++pixels;
        same_ids += blended.ids(Aov::kId, 1).at(x, y) == single.ids(Aov::kId, 1).at(x, y);
    });
    CHECK(same_ids == pixels);
}
