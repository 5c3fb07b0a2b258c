#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>

#include "apps/renderer/frame_passes.h"
#include "denoise/estimator.h"
#include "tests/renderer/support.h"

// What is filtered together is a term; a frame of several is their sum.

using namespace penumbra;
using namespace penumbra::tests;
using renderer::Denoise;
using renderer::Method;

namespace {

constexpr int kSide = 128;

// A wall that faces the camera, and on it light that only position tells apart.
float pattern(int x, int y, int salt) {
    return static_cast<float>((x * 13 + y * 7 + salt * 31) % 64) / 64.0f;
}

void fill(Plane3<float>& planes, int salt, float scale) {
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                planes[static_cast<std::size_t>(c)].at(x, y) = scale * pattern(x, y, salt + c);
}

void fill(Term& term, int salt) {
    fill(term.unshadowed, salt, 2.0f);
    fill(term.shadowed, salt + 3, 0.5f);
    fill(term.unshadowed_samples, salt + 3, 1.0f);
}

Film film_of_terms(const std::vector<int>& salts) {
    Film film;
    renderer::prepare_film(kSide, kSide, {0, 0, kSide, kSide}, 0, all_aovs(), film);
    fill(film.emission, 100, 1.0f);
    film.depth.fill(5.0f);
    film.geometric_normal[2].fill(1.0f);
    while (film.terms.size() < salts.size()) {
        Film other;
        renderer::prepare_film(kSide, kSide, {0, 0, kSide, kSide}, 0, all_aovs(), other);
        film.terms.push_back(std::move(other.terms.front()));
    }
    for (std::size_t i = 0; i < salts.size(); ++i) fill(film.terms[i], salts[i]);
    return film;
}

void finish(Film& film, Method method, Denoise denoise) {
    const ImageSettings image{
        .width = kSide, .height = kSide, .method = method, .denoise = denoise};
    const FrameContext context{.width = kSide, .height = kSide};
    Camera camera;
    camera.right = {1, 0, 0};
    camera.up = {0, 1, 0};
    camera.forward = {0, 0, -1};
    camera.focal = kSide;
    camera.center_x = camera.center_y = kSide / 2;
    const parallel::Arena arena(2);
    renderer::FrameScratch scratch;
    renderer::FrameStatistics statistics;
    renderer::finish_frame({image, context, camera, arena, nullptr}, scratch, film, statistics);
}

int unlike_bits(const Plane3<float>& a, const Plane3<float>& b) {
    int unlike = 0;
    for (std::size_t c = 0; c < 3; ++c)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                unlike += std::bit_cast<std::uint32_t>(a[c].at(x, y)) !=
                          std::bit_cast<std::uint32_t>(b[c].at(x, y));
    return unlike;
}

}  // namespace

TEST_CASE("a frame of several terms is the sum of what each of them would be alone") {
    for (const Method method : {Method::kRatio, Method::kStochastic})
        for (const Denoise denoise : {Denoise::kNone, Denoise::kNoiseDriven}) {
            Film both = film_of_terms({1, 20});
            finish(both, method, denoise);
            // The second term on top of the first one's picture.
            Film first = film_of_terms({1});
            finish(first, method, denoise);
            Film second = film_of_terms({20});
            for (std::size_t c = 0; c < 3; ++c)
                std::copy_n(first.beauty[c].row(0), first.beauty[c].allocated_elements(),
                            second.emission[c].row(0));
            finish(second, method, denoise);
            CHECK(unlike_bits(both.beauty, second.beauty) == 0);
            CHECK(unlike_bits(both.beauty, first.beauty) > kSide * kSide);
            CHECK(unlike_bits(both.terms[1].ratio, second.total().ratio) == 0);
            CHECK(unlike_bits(both.terms[0].filtered_shadowed, first.total().filtered_shadowed) ==
                  0);
        }
}

TEST_CASE("the renderer makes one term, the total, and starts every frame with it") {
    const Scene scene = read_scene(data_scene("cubes/cubes-small.json"));
    renderer::Renderer renderer(scene, {.width = 64, .height = 64}, {});
    Film film;
    for (const int frame : {1, 2}) {
        renderer.render(frame, all_aovs(), film);
        CHECK(film.terms.size() == 1);
    }
}
