#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "tests/renderer/support.h"
#include "tests/renderer/unshadowed_frame.h"

// The ratio and the stochastic estimator share S_N; they converge to the same picture if and only
// if U_N converges to U.

using namespace penumbra;
using namespace penumbra::tests;

namespace {

// What U itself may be off, of the crop's mean radiance: in the crop's mean, and in that of any
// block of pixels.
constexpr double kAllowedInCrop = 0.005;
constexpr double kAllowedInBlock = 0.02;

constexpr int kBatches = 32;
constexpr int kRaysPerBatch = 256;
constexpr int kBlockPixels = 16;

// Standard errors, of Student's t with 31 degrees of freedom: a right U fails one of the 3 x 17
// tests below with a probability of 0.1 % (two-sided, Bonferroni: 2e-5 each).
constexpr double kStandardErrors = 5.0;

// One tile of a picture with glossy surfaces, some of them seen at grazing angles.
struct Crop {
    const char* scene;
    int width, height;
    int tile_x, tile_y;
};
constexpr Crop kCrops[] = {{"cubes/cubes-medium.json", 320, 180, 0, 1},
                           {"teapot/teapot.json", 320, 180, 4, 0},
                           {"turntable/turntable.json", 320, 180, 2, 1}};

UnshadowedFrame render_crop(const Crop& crop) {
    const int x0 = crop.tile_x * kTileSize;
    const int y0 = crop.tile_y * kTileSize;
    return render_unshadowed(read_scene(data_scene(crop.scene)),
                             {.width = crop.width,
                              .height = crop.height,
                              .crop = PixelRect{x0, y0, x0 + kTileSize, y0 + kTileSize},
                              .batches = kBatches,
                              .rays_per_batch = kRaysPerBatch});
}

// Of all channels.
double mean(const Plane3<float>& planes, const PixelRect& pixels) {
    double sum = 0;
    for (const Plane<float>& plane : planes)
        for (int y = pixels.y0; y < pixels.y1; ++y)
            for (int x = pixels.x0; x < pixels.x1; ++x) sum += static_cast<double>(plane.at(x, y));
    return sum / (3.0 * pixels.width() * pixels.height());
}

struct Comparison {
    double difference;      // U - U_N
    double standard_error;  // of U_N
};

Comparison compare(const UnshadowedFrame& frame, const PixelRect& pixels) {
    std::vector<double> batches;
    for (const Plane3<float>& batch : frame.sampled) batches.push_back(mean(batch, pixels));
    const double n = static_cast<double>(batches.size());
    const double expected = std::accumulate(batches.begin(), batches.end(), 0.0) / n;
    double squares = 0;
    for (const double batch : batches) squares += (batch - expected) * (batch - expected);
    return {mean(frame.analytic, pixels) - expected, std::sqrt(squares / (n * (n - 1)))};
}

}  // namespace

TEST_CASE("U is what the frame's own shadow rays add up to, in the mean and in every block" *
          doctest::test_suite("statistics")) {
    for (const Crop& crop : kCrops) {
        CAPTURE(std::string(crop.scene));
        const UnshadowedFrame frame = render_crop(crop);
        const PixelRect all{0, 0, kTileSize, kTileSize};
        const double radiance = mean(frame.sampled.front(), all);
        REQUIRE(radiance > 0);
        const auto check = [&](const PixelRect& pixels, double allowed) {
            CAPTURE(pixels.x0);
            CAPTURE(pixels.y0);
            const Comparison c = compare(frame, pixels);
            const double noise = kStandardErrors * c.standard_error / radiance;
            CHECK(noise < 0.5 * allowed);  // else the test would say nothing
            CHECK(std::abs(c.difference) / radiance < allowed + noise);
        };
        check(all, kAllowedInCrop);
        for (int y = 0; y < kTileSize; y += kBlockPixels)
            for (int x = 0; x < kTileSize; x += kBlockPixels)
                check({x, y, x + kBlockPixels, y + kBlockPixels}, kAllowedInBlock);
    }
}

TEST_CASE("the U and U_N that are compared are those of a frame without shadows, bit for bit") {
    const Scene scene = read_scene(data_scene("teapot/teapot.json"));
    const Film film = render(scene,
                             {.width = 96,
                              .height = 80,
                              .denoise = renderer::Denoise::kNone,
                              .samples_per_pixel = kRaysPerSet,
                              .seed = 3},
                             {.visibility = shadow::Visibility::kForcedToOne});
    const UnshadowedFrame frame =
        render_unshadowed(scene, {.width = 96, .height = 80, .batches = 1, .seed = 3});
    int unlike = 0;
    each_pixel(film, [&](int x, int y) {
        for (std::size_t c = 0; c < 3; ++c) {
            unlike += frame.analytic[c].at(x, y) != film.total().unshadowed[c].at(x, y);
            unlike += frame.sampled[0][c].at(x, y) != film.total().unshadowed_samples[c].at(x, y);
        }
        unlike += frame.material.at(x, y) != film.ids(Aov::kId, 2).at(x, y);
    });
    CHECK(unlike == 0);
}
