#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include "core/frame/surface.h"
#include "denoise/joint_bilateral.h"
#include "denoise/noise_estimate.h"

// A made-up frame: a floor that runs away from the viewer, a wall behind it, some sky; a striped
// shadow with penumbrae, noise of one sample per pixel, and some pixels where nothing was learned.
// Every number is a function of the full frame's pixel, so that windows of one frame agree.

namespace penumbra::denoise::tests {

inline float unit_random(int x, int y, std::uint32_t salt) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b9u ^
                      static_cast<std::uint32_t>(y) * 0x85ebca6bu ^ salt * 0xc2b2ae35u;
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    h ^= h >> 16;
    return static_cast<float>(h >> 8) * 0x1p-24f;
}

struct TestFrame {
    explicit TestFrame(const FrameWindow& frame)
        : window(frame),
          shadowed(planes()),
          samples(planes()),
          unshadowed(planes()),
          emission(planes()),
          normal(planes()),
          beauty(planes()),
          ratio(planes()),
          filtered_shadowed(planes()),
          filtered_samples(planes()),
          depth(width(), height()),
          noise(width(), height()) {}

    [[nodiscard]] int width() const { return window.window.width(); }
    [[nodiscard]] int height() const { return window.window.height(); }
    [[nodiscard]] Plane3<float> planes() const { return make_plane3<float>(width(), height()); }

    FrameWindow window;
    Camera camera;
    Plane3<float> shadowed, samples, unshadowed, emission, normal;
    Plane3<float> beauty, ratio, filtered_shadowed, filtered_samples;
    Plane<float> depth, noise;
};

inline Camera test_camera(int width, int height) {
    Camera camera;
    camera.eye = {0.5f, 2.0f, 1.0f};
    camera.right = {1, 0, 0};
    camera.up = {0, 0.96f, -0.28f};
    camera.forward = {0, -0.28f, -0.96f};
    camera.focal = static_cast<float>(width);
    camera.center_x = 0.5f * static_cast<float>(width);
    camera.center_y = 0.5f * static_cast<float>(height);
    return camera;
}

// Floor at height 0, a slanted wall from 9 metres on, sky in a corner.
inline void set_surface(TestFrame& frame, int x, int y, int i, int j) {
    const Vec3f d =
        frame.camera.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    const Vec3f wall{0.28f, 0, 0.96f};
    const float to_wall = (-9 - dot(wall, frame.camera.eye)) / dot(wall, d);
    const float to_floor = d.y < 0 ? -frame.camera.eye.y / d.y : 1e9f;
    const bool is_sky = y < 6 && x >= 40;
    const Vec3f n = is_sky ? Vec3f{0, 0, 0} : to_floor < to_wall ? Vec3f{0, 1, 0} : wall;
    // A relief of a tenth of a pixel's size lets the plane weights take all values.
    const float relief = 1 + 0.1f * unit_random(x, y, 9) / frame.camera.focal;
    frame.depth.at(i, j) = is_sky ? kDepthOfNothing : std::min(to_floor, to_wall) * relief;
    frame.normal[0].at(i, j) = n.x;
    frame.normal[1].at(i, j) = n.y;
    frame.normal[2].at(i, j) = n.z;
}

inline void set_light(TestFrame& frame, int x, int y, int i, int j) {
    const float phase = static_cast<float>((x + 2 * y) % 120) / 120.0f;
    const float visible = std::clamp(8 * std::fabs(phase - 0.5f) - 1.2f, 0.0f, 1.0f);
    const bool is_lit = unit_random(x, y, 1) < visible;
    const bool is_sky = frame.depth.at(i, j) >= kDepthOfNothing;
    const bool is_learned = !is_sky && unit_random(x, y, 2) > 0.03f;
    for (std::size_t c = 0; c < 3; ++c) {
        const float light = 0.2f + unit_random(x, y, 3) * (1 + 0.3f * static_cast<float>(c));
        frame.samples[c].at(i, j) = is_learned ? light : 0.0f;
        frame.shadowed[c].at(i, j) = is_learned && is_lit ? light * (c == 2 ? 0.75f : 1.0f) : 0.0f;
        frame.unshadowed[c].at(i, j) = is_sky ? 0.0f : 0.3f + 0.5f * unit_random(x / 7, y / 5, 4);
        frame.emission[c].at(i, j) = unit_random(x, y, 5) < 0.1f ? 2 * unit_random(x, y, 6) : 0.0f;
    }
}

inline TestFrame make_test_frame(const FrameWindow& window) {
    TestFrame frame(window);
    frame.camera = test_camera(window.width, window.height);
    const PixelRect pixels = window.pixels();
    for (int y = pixels.y0; y < pixels.y1; ++y)
        for (int x = pixels.x0; x < pixels.x1; ++x) {
            set_surface(frame, x, y, x - window.window.x0, y - window.window.y0);
            set_light(frame, x, y, x - window.window.x0, y - window.window.y0);
        }
    return frame;
}
inline TestFrame make_test_frame(int width, int height) {
    return make_test_frame({width, height, {0, 0, width, height}});
}

// How a test runs the passes: nothing of this may change a bit.
struct Run {
    simd::Isa isa = simd::Isa::kAvx2;
    int band_height = 64;
};

struct Settings {
    NoiseSettings noise;
    FilterSettings filter;
    Estimator estimator = Estimator::kRatio;
    NoiseOf noise_of = NoiseOf::kShadow;
};

inline void for_each_band(const TestFrame& frame, const Run& run,
                          const std::function<void(const PixelRect&)>& body) {
    const PixelRect pixels = frame.window.pixels();
    for (int y = pixels.y0; y < pixels.y1; y += run.band_height)
        body({pixels.x0, y, pixels.x1, std::min(y + run.band_height, pixels.y1)});
}

inline ConstTermView term_of(const TestFrame& frame) {
    return {.unshadowed = view(frame.unshadowed),
            .shadowed = view(frame.shadowed),
            .unshadowed_samples = view(frame.samples),
            .noise = frame.noise.view()};
}
inline TermView term_of(TestFrame& frame) {
    return {.unshadowed = view(frame.unshadowed),
            .shadowed = view(frame.shadowed),
            .unshadowed_samples = view(frame.samples),
            .noise = frame.noise.view()};
}

inline CombineInputs inputs_of(const TestFrame& frame, Estimator estimator) {
    return {.term = term_of(frame), .emission = view(frame.emission), .estimator = estimator};
}
inline CombineOutputs outputs_of(TestFrame& frame) {
    return {.beauty = view(frame.beauty),
            .ratio = view(frame.ratio),
            .shadowed = view(frame.filtered_shadowed),
            .unshadowed_samples = view(frame.filtered_samples)};
}

inline void run_noise(TestFrame& frame, const Settings& settings, const Run& run) {
    const NoisePass pass{.frame = frame.window,
                         .term = term_of(std::as_const(frame)),
                         .noise = frame.noise.view(),
                         .settings = settings.noise,
                         .isa = run.isa,
                         .noise_of = settings.noise_of};
    Scratch scratch(frame.width());
    for_each_band(frame, run, [&](const PixelRect& band) { estimate_noise(pass, band, scratch); });
}

inline FilterGuides guides_of(const TestFrame& frame) {
    return {.depth = frame.depth.view(), .normal = view(frame.normal), .camera = frame.camera};
}

inline void run_filter(TestFrame& frame, const Settings& settings, const Run& run) {
    const HorizontalFilterPass rows{.frame = frame.window,
                                    .guides = guides_of(frame),
                                    .term = term_of(frame),
                                    .settings = settings.filter,
                                    .isa = run.isa};
    Scratch scratch(frame.width());
    for_each_band(frame, run, [&](const PixelRect& band) {
        filter_horizontally(rows, band.y0, band.y1, scratch);
    });
    const VerticalFilterPass columns{.frame = frame.window,
                                     .guides = guides_of(frame),
                                     .sums = inputs_of(frame, settings.estimator),
                                     .outputs = outputs_of(frame),
                                     .settings = settings.filter,
                                     .isa = run.isa};
    for_each_band(frame, run, [&](const PixelRect& band) { filter_vertically(columns, band); });
}

inline void run_chain(TestFrame& frame, const Settings& settings = {}, const Run& run = {}) {
    run_noise(frame, settings, run);
    run_filter(frame, settings, run);
}

// Visits every pixel of the frame that the planes hold, by element.
inline void for_each_pixel(const TestFrame& frame, const std::function<void(int i, int j)>& body) {
    const PixelRect pixels = frame.window.pixels();
    for (int y = pixels.y0; y < pixels.y1; ++y)
        for (int x = pixels.x0; x < pixels.x1; ++x)
            body(x - frame.window.window.x0, y - frame.window.window.y0);
}

inline bool same_bits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

// Elements at which two frames' planes differ in any bit.
inline int count_differences(const TestFrame& frame, const Plane<float>& a, const Plane<float>& b) {
    int differences = 0;
    for_each_pixel(frame, [&](int i, int j) { differences += !same_bits(a.at(i, j), b.at(i, j)); });
    return differences;
}
inline int count_differences(const TestFrame& frame, const Plane3<float>& a,
                             const Plane3<float>& b) {
    int differences = 0;
    for (std::size_t c = 0; c < 3; ++c) differences += count_differences(frame, a[c], b[c]);
    return differences;
}

}  // namespace penumbra::denoise::tests
