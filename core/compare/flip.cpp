#include "core/compare/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/compare/flip_formula.h"
#include "core/compare/flip_kernel.h"
#include "core/simd/isa.h"

namespace penumbra::compare {
namespace {

// A Gaussian of the contrast sensitivity of one opponent channel, 2020, table 1: amplitude a and
// falloff b in degrees^2.
struct Sensitivity {
    double amplitude, falloff;
    // Along one axis, without the amplitude.
    [[nodiscard]] double at(int pixels) const {
        const double degrees = pixels / kPixelsPerDegree;
        return std::exp(-std::numbers::pi * std::numbers::pi * degrees * degrees / falloff);
    }
    // The factor in front of the two-dimensional kernel.
    [[nodiscard]] double scale() const { return amplitude * std::sqrt(std::numbers::pi / falloff); }
};
constexpr Sensitivity kAchromatic{1, 0.0047};
constexpr Sensitivity kRedGreen{1, 0.0053};
constexpr Sensitivity kBlueYellow[2] = {{34.1, 0.04}, {13.5, 0.025}};

// All share the radius of the widest: 3 standard deviations.
int sensitivity_radius() {
    const double sigma = std::sqrt(0.04 / (2 * std::numbers::pi * std::numbers::pi));
    return static_cast<int>(std::ceil(3 * sigma * kPixelsPerDegree));
}

// `share`: what the two-dimensional kernel sums to.
Filter sensitivity_filter(const Sensitivity& sensitivity, double share) {
    const int radius = sensitivity_radius();
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) sum += sensitivity.at(x);
    Filter filter;
    for (int x = -radius; x <= radius; ++x)
        filter.weights.push_back(static_cast<float>(sensitivity.at(x) / sum * std::sqrt(share)));
    return filter;
}

// The two-dimensional weight of each of the two Gaussians of blue-yellow.
double blue_yellow_share(int which) {
    double mass[2];
    for (int i = 0; i < 2; ++i) {
        double sum = 0;
        for (int x = -sensitivity_radius(); x <= sensitivity_radius(); ++x)
            sum += kBlueYellow[i].at(x);
        mass[i] = kBlueYellow[i].scale() * sum * sum;
    }
    return mass[which] / (mass[0] + mass[1]);
}

// Scales the positive weights to a sum of 1 and the negative ones to -1, section 3.2.
Filter balanced(const std::vector<double>& values) {
    double positive = 0, negative = 0;
    for (const double value : values) (value > 0 ? positive : negative) += value;
    Filter filter;
    for (const double value : values)
        filter.weights.push_back(
            static_cast<float>(value > 0 ? value / positive : value / -negative));
    return filter;
}

struct FeatureFilters {
    Filter smooth, edge, point;
};

// Section 3.2: the first and second derivative of a Gaussian whose extent is that of the largest
// feature humans see as a detail, 0.082 degrees.
FeatureFilters feature_filters() {
    const double sigma = 0.5 * 0.082 * kPixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    std::vector<double> edge, point;
    for (int x = -radius; x <= radius; ++x) {
        const double weight = std::exp(-x * x / (2 * sigma * sigma));
        edge.push_back(-x * weight);
        point.push_back((x * x / (sigma * sigma) - 1) * weight);
    }
    return {gaussian(sigma, radius), balanced(edge), balanced(point)};
}

struct Filters {
    Filter achromatic = sensitivity_filter(kAchromatic, 1);
    Filter red_green = sensitivity_filter(kRedGreen, 1);
    Filter blue_yellow[2] = {sensitivity_filter(kBlueYellow[0], blue_yellow_share(0)),
                             sensitivity_filter(kBlueYellow[1], blue_yellow_share(1))};
    FeatureFilters feature = feature_filters();
};

const Filters& filters() {
    static const Filters all;
    return all;
}

// One picture's region, filtered.
struct Filtered {
    Plane3<float> colour;
    Plane<float> edge[2], point[2];

    [[nodiscard]] FlipFeatures row(int y) const {
        return {{colour[0].row(y), colour[1].row(y), colour[2].row(y)},
                {edge[0].row(y), edge[1].row(y)},
                {point[0].row(y), point[1].row(y)}};
    }
};

Plane3<float> to_opponent(const Plane3<float>& linear, const Extent& extent) {
    const auto convert =
        simd::pick(simd::best_isa(), &avx2::flip_opponent_row, &avx512::flip_opponent_row);
    Plane3<float> ycxcz = {make_region(extent), make_region(extent), make_region(extent)};
    for (int y = 0; y < extent.padded_height(); ++y) {
        const float* const from[3] = {linear[0].row(y), linear[1].row(y), linear[2].row(y)};
        float* const to[3] = {ycxcz[0].row(y), ycxcz[1].row(y), ycxcz[2].row(y)};
        convert(from, to, extent.padded_width());
    }
    return ycxcz;
}

// Filters of one plane, with scratch for the rows.
class PlaneFilter {
  public:
    PlaneFilter(const Plane<float>& from, const Extent& extent)
        : from_(from), extent_(extent), rows_(make_region(extent)) {}
    // Along x with one filter, along y with another.
    Plane<float> operator()(const Filter& along_x, const Filter& along_y) {
        Plane<float> to(extent_.width, extent_.height);
        filter_rows(from_, along_x, extent_, rows_);
        filter_columns(rows_, along_y, extent_, to);
        return to;
    }

  private:
    const Plane<float>& from_;
    const Extent& extent_;
    Plane<float> rows_;
};

void add(const Plane<float>& from, const Extent& extent, Plane<float>& to) {
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) to.at(x, y) += from.at(x, y);
}

// Features are found in Y from 0 to 1 instead of -16 to 100. The derivatives ignore constants, so
// the factor alone remains.
void scale_to_unit(Plane<float>& plane, const Extent& extent) {
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) plane.at(x, y) *= 1.0f / 116;
}

Filtered filter_picture(const Plane3<float>& linear, const Extent& extent) {
    const Plane3<float> ycxcz = to_opponent(linear, extent);
    const Filters& f = filters();
    PlaneFilter luma(ycxcz[0], extent), red_green(ycxcz[1], extent), blue_yellow(ycxcz[2], extent);
    const auto& [smooth, edge, point] = f.feature;
    Filtered result{{luma(f.achromatic, f.achromatic), red_green(f.red_green, f.red_green),
                     blue_yellow(f.blue_yellow[0], f.blue_yellow[0])},
                    {luma(edge, smooth), luma(smooth, edge)},
                    {luma(point, smooth), luma(smooth, point)}};
    add(blue_yellow(f.blue_yellow[1], f.blue_yellow[1]), extent, result.colour[2]);
    for (int axis = 0; axis < 2; ++axis) {
        scale_to_unit(result.edge[axis], extent);
        scale_to_unit(result.point[axis], extent);
    }
    return result;
}

// Between green and blue, the two colours of a display that are farthest apart.
float largest_distance() {
    static const float largest =
        colour_distance(hunt_lab_from_linear(Vec3f{0, 1, 0}), hunt_lab_from_linear(Vec3f{0, 0, 1}));
    return largest;
}

void expose(const Plane3<float>& scene, double ev, const Extent& extent, Plane3<float>& display) {
    const auto tone = simd::pick(simd::best_isa(), &avx2::flip_tone_row, &avx512::flip_tone_row);
    const auto scale = static_cast<float>(std::exp2(ev));
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (int y = 0; y < extent.padded_height(); ++y)
            tone(scene[channel].row(y), scale, display[channel].row(y), extent.padded_width());
}

}  // namespace

void flip_map(const Plane3<float>& reference, const Plane3<float>& test, const Extent& extent,
              Plane<float>& errors) {
    const auto error_row =
        simd::pick(simd::best_isa(), &avx2::flip_error_row, &avx512::flip_error_row);
    const Filtered a = filter_picture(reference, extent);
    const Filtered b = filter_picture(test, extent);
    for (int y = 0; y < extent.height; ++y)
        error_row(a.row(y), b.row(y), largest_distance(), errors.row(y), extent.width);
}

Exposures choose_exposures(double median_luminance, double largest_luminance) {
    if (!(median_luminance > 0)) return {0, 0, 1};
    // The tone curve reaches t where (2.51 - 2.43 t) v^2 + (0.03 - 0.59 t) v - 0.14 t = 0, v = 0.6
    // x.
    constexpr double t = 0.85;
    constexpr double a = 2.51 - 2.43 * t, b = 0.03 - 0.59 * t, c = -0.14 * t;
    const double shown = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a) / 0.6;
    Exposures exposures;
    exposures.start = std::log2(shown / largest_luminance);
    exposures.stop = std::log2(shown / median_luminance);
    const double span = exposures.stop - exposures.start;
    exposures.count = span > 0 ? std::max(2, static_cast<int>(std::ceil(span))) : 1;
    return exposures;
}

void hdr_flip_map(const Plane3<float>& reference, const Plane3<float>& test,
                  const Exposures& exposures, const Extent& extent, Plane<float>& errors) {
    Plane3<float> a = {make_region(extent), make_region(extent), make_region(extent)};
    Plane3<float> b = {make_region(extent), make_region(extent), make_region(extent)};
    Plane<float> once(extent.width, extent.height);
    errors.fill(0);
    for (int i = 0; i < exposures.count; ++i) {
        expose(reference, exposures.ev(i), extent, a);
        expose(test, exposures.ev(i), extent, b);
        flip_map(a, b, extent, once);
        for (int y = 0; y < extent.height; ++y)
            for (int x = 0; x < extent.width; ++x)
                errors.at(x, y) = std::max(errors.at(x, y), once.at(x, y));
    }
}

}  // namespace penumbra::compare
