#include "tests/benchmarks/unshadowed_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/compare/flip.h"
#include "core/compare/transfer.h"
#include "core/frame/visibility.h"

namespace penumbra::tests {
namespace {

constexpr double kCosViewBins[] = {0, 0.1, 0.2, 0.4, 0.7, 1};

// FLIP is seen at the exposure that shows this share of the lit pixels below this luminance.
constexpr double kShownShare = 0.95;
constexpr double kShownLuminance = 0.8;

// A pixel's radiance by the three estimates.
struct Pixel {
    double test[3], a[3], b[3];
    [[nodiscard]] double reference(int c) const { return 0.5 * (a[c] + b[c]); }
    [[nodiscard]] double error(int c) const { return test[c] - reference(c); }
    [[nodiscard]] double noise(int c) const { return 0.5 * (a[c] - b[c]); }
};

double sum(const double (&v)[3]) {
    return v[0] + v[1] + v[2];
}

Pixel pixel_at(const UnshadowedFrame& frame, int x, int y) {
    Pixel pixel;
    for (std::size_t c = 0; c < 3; ++c) {
        pixel.test[c] = static_cast<double>(frame.analytic[c].at(x, y));
        pixel.a[c] = static_cast<double>(frame.sampled[0][c].at(x, y));
        pixel.b[c] = static_cast<double>(frame.sampled[1][c].at(x, y));
    }
    return pixel;
}

// Calls body(x, y, pixel).
template <class Body>
void each_lit_pixel(const UnshadowedFrame& frame, const Body& body) {
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            const Pixel pixel = pixel_at(frame, x, y);
            if (sum(pixel.test) + sum(pixel.a) + sum(pixel.b) > 0) body(x, y, pixel);
        }
}

// Where U is off by b, and A and B have the variance v each, (U - M)^2 - ((A - B) / 2)^2, which is
// (U - A) (U - B), has the variance 2 b^2 v + v^2; (A - B)^2 is 2 v on average, its square 12 v^2.
// Channels share their samples: they are added up first.
void add(const Pixel& pixel, Group& group) {
    double squared = 0;
    double noise = 0;
    for (int c = 0; c < 3; ++c) {
        group.error += pixel.error(c);
        squared += pixel.error(c) * pixel.error(c);
        noise += pixel.noise(c) * pixel.noise(c);
    }
    group.pixels += 1;
    group.squared += squared;
    group.noise += noise;
    group.variance += 4 * noise * std::max(squared - noise, 0.0) + 16 * noise * noise / 12;
}

double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

// |difference| of the channels' sums, relative to a reference; what is there without one is all
// error.
double relative(double difference, double reference) {
    if (difference == 0) return 0;
    return reference > 0 ? std::abs(difference) / reference : 1;
}

double luminance(const Plane3<float>& p, int x, int y) {
    return 0.2126 * static_cast<double>(p[0].at(x, y)) +
           0.7152 * static_cast<double>(p[1].at(x, y)) +
           0.0722 * static_cast<double>(p[2].at(x, y));
}

double fitting_exposure(const UnshadowedFrame& frame, const Plane3<float>& reference) {
    std::vector<double> values;
    each_lit_pixel(
        frame, [&](int x, int y, const Pixel&) { values.push_back(luminance(reference, x, y)); });
    const double bright = percentile(std::move(values), kShownShare);
    return bright > 0 ? std::log2(kShownLuminance / bright) : 0;
}

// With its edge repeated round it, exposed, and clamped to what a display shows.
Plane3<float> shown(const Plane3<float>& from, double exposure_ev, const compare::Extent& extent) {
    const auto scale = static_cast<float>(std::exp2(exposure_ev));
    Plane3<float> to;
    for (std::size_t c = 0; c < 3; ++c) {
        to[c] = compare::make_region(extent);
        for (int y = 0; y < extent.padded_height(); ++y)
            for (int x = 0; x < extent.padded_width(); ++x)
                to[c].at(x, y) =
                    scale * from[c].at(std::clamp(x - extent.halo, 0, extent.width - 1),
                                       std::clamp(y - extent.halo, 0, extent.height - 1));
    }
    return compare::transfer(to, compare::Transfer::kClamp, extent);
}

FlipErrors measure_flip(const UnshadowedFrame& frame) {
    const Plane3<float> reference = mean_of_halves(frame);
    FlipErrors errors{.exposure_ev = fitting_exposure(frame, reference)};
    const compare::Extent extent{frame.width, frame.height, compare::kFlipHalo};
    const auto flip = [&](const Plane3<float>& a, const Plane3<float>& b) {
        Plane<float> map(extent.width, extent.height);
        compare::flip_map(shown(a, errors.exposure_ev, extent),
                          shown(b, errors.exposure_ev, extent), extent, map);
        double total = 0;
        for (int y = 0; y < extent.height; ++y)
            for (int x = 0; x < extent.width; ++x) total += static_cast<double>(map.at(x, y));
        return total / (static_cast<double>(extent.width) * extent.height);
    };
    errors.test = flip(reference, frame.analytic);
    errors.noise = flip(reference, frame.sampled[0]);
    errors.halves = flip(frame.sampled[0], frame.sampled[1]);
    return errors;
}

std::size_t cos_view_bin(float cos_view) {
    std::size_t bin = 0;
    while (bin + 2 < std::size(kCosViewBins) &&
           static_cast<double>(cos_view) >= kCosViewBins[bin + 1])
        ++bin;
    return bin;
}

void add_groups(const UnshadowedFrame& frame, const Scene& scene, UnshadowedErrors& errors) {
    for (std::size_t i = 0; i + 1 < std::size(kCosViewBins); ++i)
        errors.by_cos_view.push_back(
            {.name = fmt::format("n.v {:.1f} to {:.1f}", kCosViewBins[i], kCosViewBins[i + 1])});
    for (const Material& material : scene.materials)
        errors.by_material.push_back({.name = material.name});
    each_lit_pixel(frame, [&](int x, int y, const Pixel& pixel) {
        add(pixel, errors.all);
        add(pixel, errors.by_cos_view[cos_view_bin(frame.cos_view.at(x, y))]);
        add(pixel, errors.by_material[frame.material.at(x, y)]);
    });
    std::stable_sort(
        errors.by_material.begin(), errors.by_material.end(),
        [](const Group& a, const Group& b) { return a.squared - a.noise > b.squared - b.noise; });
}

void measure_pixels(const UnshadowedFrame& frame, UnshadowedErrors& errors) {
    double radiance = 0;
    double noise = 0;
    std::vector<double> relative_errors, relative_noise;
    each_lit_pixel(frame, [&](int, int, const Pixel& pixel) {
        const double reference = 0.5 * (sum(pixel.a) + sum(pixel.b));
        const double half_difference = 0.5 * (sum(pixel.a) - sum(pixel.b));
        radiance += reference;
        noise += half_difference;
        relative_errors.push_back(relative(sum(pixel.test) - reference, reference));
        relative_noise.push_back(relative(half_difference, reference));
    });
    const double values = std::max(3.0 * static_cast<double>(relative_errors.size()), 1.0);
    errors.radiance = radiance / values;
    errors.noise_of_mean = std::abs(noise) / values;
    errors.relative_99 = percentile(std::move(relative_errors), 0.99);
    errors.noise_relative_99 = percentile(std::move(relative_noise), 0.99);
}

// White at 0.
void paint(double relative_error, std::uint8_t* rgb) {
    constexpr double kFull = 0.1;
    const double share = std::clamp(relative_error / kFull, -1.0, 1.0);
    const auto rest = static_cast<std::uint8_t>(std::lround(255 * (1 - std::abs(share))));
    rgb[0] = share < 0 ? rest : 255;
    rgb[1] = rest;
    rgb[2] = share > 0 ? rest : 255;
}

}  // namespace

double Group::mean() const {
    return pixels > 0 ? error / (3 * pixels) : 0;
}
double Group::rmse() const {
    return pixels > 0 ? std::sqrt(std::max(squared - noise, 0.0) / (3 * pixels)) : 0;
}
double Group::rmse_at_most() const {
    const double most = std::max(squared - noise, 0.0) + 2 * std::sqrt(variance);
    return pixels > 0 ? std::sqrt(most / (3 * pixels)) : 0;
}
double Group::noise_rms() const {
    return pixels > 0 ? std::sqrt(noise / (3 * pixels)) : 0;
}

double FlipErrors::at_least() const {
    return std::max(test - noise, 0.0);
}
double FlipErrors::at_most() const {
    return std::sqrt(std::max(test * test - noise * noise, 0.0));
}

UnshadowedErrors measure_unshadowed(const UnshadowedFrame& frame, const Scene& scene) {
    UnshadowedErrors errors;
    errors.pixels = static_cast<double>(frame.width) * frame.height;
    measure_pixels(frame, errors);
    add_groups(frame, scene, errors);
    errors.flip = measure_flip(frame);
    return errors;
}

Plane3<float> mean_of_halves(const UnshadowedFrame& frame) {
    Plane3<float> mean = make_plane3<float>(frame.width, frame.height);
    for (std::size_t c = 0; c < 3; ++c)
        for (int y = 0; y < frame.height; ++y)
            for (int x = 0; x < frame.width; ++x)
                mean[c].at(x, y) =
                    0.5f * (frame.sampled[0][c].at(x, y) + frame.sampled[1][c].at(x, y));
    return mean;
}

image::Picture relative_error_picture(const UnshadowedFrame& frame) {
    constexpr std::uint8_t kGrey = 128;
    const std::size_t pixels =
        static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
    image::Picture picture{frame.width, frame.height, 3,
                           std::vector<std::uint8_t>(3 * pixels, kGrey)};
    each_lit_pixel(frame, [&](int x, int y, const Pixel& pixel) {
        const double reference = 0.5 * (sum(pixel.a) + sum(pixel.b));
        const double error = sum(pixel.test) - reference;
        const std::size_t index =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
            static_cast<std::size_t>(x);
        paint(std::copysign(relative(error, reference), error), &picture.bytes[3 * index]);
    });
    return picture;
}

}  // namespace penumbra::tests
