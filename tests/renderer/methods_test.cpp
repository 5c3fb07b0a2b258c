#include <doctest/doctest.h>

#include <cmath>

#include "tests/renderer/support.h"

// How the methods end, and what filters them; the ratio itself: ratio_test.cpp.

using namespace penumbra;
using namespace penumbra::tests;
using renderer::Denoise;
using renderer::Method;

namespace {

const Scene& cubes() {
    static const Scene kScene = read_scene(data_scene("cubes/cubes-large.json"));
    return kScene;
}

ImageSettings small(Method method, std::optional<Denoise> denoise, int samples) {
    return {.width = 192,
            .height = 108,
            .method = method,
            .denoise = denoise,
            .samples_per_pixel = samples};
}

Film stochastic(Denoise denoise, int samples) {
    return render(cubes(), small(Method::kStochastic, denoise, samples));
}

double square_difference(const Film& a, const Film& b) {
    double sum = 0;
    each_pixel(a, [&](int x, int y) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double d = a.beauty[c].at(x, y) - b.beauty[c].at(x, y);
            sum += d * d;
        }
    });
    return sum;
}

}  // namespace

TEST_CASE("a method that is not told how takes its own filter") {
    const auto filter_of = [](Method method, std::optional<Denoise> denoise) {
        return *renderer::completed(cubes(), small(method, denoise, 1)).denoise;
    };
    CHECK(filter_of(Method::kRatio, {}) == Denoise::kNoiseDriven);
    CHECK(filter_of(Method::kStochastic, {}) == Denoise::kNone);
    CHECK(filter_of(Method::kUnshadowed, {}) == Denoise::kNone);
    CHECK(filter_of(Method::kRatio, Denoise::kNone) == Denoise::kNone);
    CHECK(filter_of(Method::kStochastic, Denoise::kNoiseDriven) == Denoise::kNoiseDriven);
}

TEST_CASE("unshadowed light is emission + U, traces nothing and has nothing to filter") {
    renderer::Renderer renderer(cubes(), small(Method::kUnshadowed, {}, 4), {});
    Film film;
    CHECK(renderer.render(1, all_aovs(), film).shadow_rays == 0);
    int unlike = 0;
    each_pixel(film, [&](int x, int y) {
        for (std::size_t c = 0; c < 3; ++c) {
            unlike += film.beauty[c].at(x, y) !=
                      film.emission[c].at(x, y) + film.total().unshadowed[c].at(x, y);
            unlike += film.total().ratio[c].at(x, y) != 1.0f;
        }
    });
    CHECK(unlike == 0);
    const ImageSettings filtered = small(Method::kUnshadowed, Denoise::kNoiseDriven, 4);
    CHECK(digest(render(cubes(), filtered)) == digest(film));
}

TEST_CASE("with visibility 1 the filtered stochastic frame is emission + the filtered U_N") {
    const Film film = render(cubes(), small(Method::kStochastic, Denoise::kNoiseDriven, 1),
                             {.visibility = shadow::Visibility::kForcedToOne});
    int unlike = 0;
    each_pixel(film, [&](int x, int y) {
        for (std::size_t c = 0; c < 3; ++c)
            unlike +=
                film.beauty[c].at(x, y) !=
                film.emission[c].at(x, y) + film.total().filtered_unshadowed_samples[c].at(x, y);
    });
    CHECK(unlike == 0);
}

TEST_CASE("the filtered stochastic frame of one ray lies nearer to the converged one") {
    const Film converged = stochastic(Denoise::kNone, 64);
    const double raw = square_difference(stochastic(Denoise::kNone, 1), converged);
    const double filtered = square_difference(stochastic(Denoise::kNoiseDriven, 1), converged);
    MESSAGE("filtering leaves " << filtered / raw << " of the squared error");
    CHECK(filtered < 0.5 * raw);
}

TEST_CASE("the filtered stochastic frame tends to the unfiltered one as rays are added") {
    const auto effect = [](int samples) {
        return square_difference(stochastic(Denoise::kNoiseDriven, samples),
                                 stochastic(Denoise::kNone, samples));
    };
    const double few = effect(1);
    CHECK(effect(64) < 0.2 * few);
}
