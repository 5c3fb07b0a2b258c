#include "tests/denoise/reference_chain.h"

#include "denoise/noise_formula.h"

namespace penumbra::denoise::tests {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct Frame {
    const TestFrame& data;
    int width = data.width(), height = data.height();
    [[nodiscard]] bool contains(int x, int y) const {
        return x >= 0 && y >= 0 && x < width && y < height;
    }
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

double luminance_of(const Plane3<float>& planes, int x, int y) {
    return 0.2126 * planes[0].at(x, y) + 0.7152 * planes[1].at(x, y) + 0.0722 * planes[2].at(x, y);
}

// ---- noise -----------------------------------------------------------------------------------

// W_N, or nothing.
bool shadow_at(const Frame& frame, int x, int y, double& w) {
    if (!frame.contains(x, y)) return false;
    const double known = luminance_of(frame.data.samples, x, y);
    if (known <= 0) return false;
    w = luminance_of(frame.data.shadowed, x, y) / known;
    return true;
}

double line_noise_at(const Frame& frame, int x, int y, double angle,
                     const NoiseSettings& settings) {
    const int r = settings.radius;
    const auto known_at = [&](int i, double& w) {
        return shadow_at(frame, x + static_cast<int>(std::lrint(i * std::cos(angle))),
                         y + static_cast<int>(std::lrint(i * std::sin(angle))), w);
    };
    double variation = 0;
    int known = 0;
    for (int i = -r + 2; i <= r; ++i) {
        double a = 0, b = 0, c = 0;
        if (!known_at(i - 2, a) || !known_at(i - 1, b) || !known_at(i, c)) continue;
        variation += std::fabs(a - 2 * b + c);
        ++known;
    }
    if (known > 0) variation *= (2.0 * r - 1) / known;
    return std::min(1.0, std::sqrt(variation / r) / settings.full_noise);
}

double star_noise_at(const Frame& frame, int x, int y, const NoiseSettings& settings) {
    const int rotation = line_rotation(x / 16 * 16, y);
    double largest = 0, sum = 0;
    for (int line = 0; line < 4; ++line) {
        const double noise =
            line_noise_at(frame, x, y, (line + rotation / 16.0) * kPi / 4, settings);
        largest = std::max(largest, noise);
        sum += noise;
    }
    return settings.rule == LineRule::kMaximum ? largest : sum / 4;
}

double boxed(const Frame& frame, const Image& image, int x, int y) {
    double sum = 0;
    int count = 0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (frame.contains(x + dx, y + dy)) {
                sum += image[frame.index(x + dx, y + dy)];
                ++count;
            }
    return sum / count;
}

// ---- filter ----------------------------------------------------------------------------------

Vec3d to_double(const Vec3f& v) {
    return {v.x, v.y, v.z};
}

Vec3d normal_at(const Frame& frame, int x, int y) {
    return {frame.data.normal[0].at(x, y), frame.data.normal[1].at(x, y),
            frame.data.normal[2].at(x, y)};
}

Vec3d position_at(const Frame& frame, int x, int y) {
    const Camera& camera = frame.data.camera;
    const double a = (x + 0.5 - camera.center_x) / camera.focal;
    const double b = (camera.center_y - y - 0.5) / camera.focal;
    const Vec3d d =
        to_double(camera.forward) + a * to_double(camera.right) + b * to_double(camera.up);
    return to_double(camera.eye) + static_cast<double>(frame.data.depth.at(x, y)) * d;
}

double tap_weight(const Frame& frame, int x, int y, int dx, int dy,
                  const FilterSettings& settings) {
    const int r = std::abs(dx + dy);
    const Camera& camera = frame.data.camera;
    const Vec3d n = normal_at(frame, x, y);
    const Vec3d offset = position_at(frame, x + dx, y + dy) - position_at(frame, x, y);
    const double cosine = std::max(0.0, dot(n, normal_at(frame, x + dx, y + dy)));
    const double normal = std::max(0.0, 1 - settings.normal_weight * (1 - std::pow(cosine, 4)));
    const Vec3d view =
        (position_at(frame, x, y) - to_double(camera.eye)) * (1.0 / frame.data.depth.at(x, y));
    const Vec3d step = to_double(dx != 0 ? camera.right : camera.up) * (1.0 / camera.focal);
    const double slant = dot(n, step) / std::min(dot(n, view), -1e-3);
    const double pixel = frame.data.depth.at(x, y) * std::sqrt(slant * slant + dot(step, step));
    const double plane =
        std::max(0.0, 1 - settings.plane_weight * std::fabs(dot(n, offset)) / (r * pixel));
    return normal * plane * plane;
}

using Six = std::array<Image, 6>;

std::array<double, 6> filtered_at(const Frame& frame, const Six& in, int x, int y, bool is_row,
                                  const FilterSettings& settings) {
    std::array<double, 6> sums{};
    for (std::size_t c = 0; c < 6; ++c) sums[c] = in[c][frame.index(x, y)];
    const double radius =
        settings.radius *
        std::min(1.0, static_cast<double>(settings.radius_per_noise) * frame.data.noise.at(x, y));
    if (radius <= settings.smallest_radius || frame.data.depth.at(x, y) >= kDepthOfNothing)
        return sums;
    double weights = 1;
    for (int r = -settings.radius; r <= settings.radius; ++r) {
        const int dx = is_row ? r : 0, dy = is_row ? 0 : r;
        if (r == 0 || std::abs(r) > 2.5 * radius || !frame.contains(x + dx, y + dy)) continue;
        const double weight =
            std::exp(-r * r / (radius * radius)) * tap_weight(frame, x, y, dx, dy, settings);
        weights += weight;
        for (std::size_t c = 0; c < 6; ++c) sums[c] += weight * in[c][frame.index(x + dx, y + dy)];
    }
    for (double& sum : sums) sum /= weights;
    return sums;
}

}  // namespace

Image reference_noise(const TestFrame& data, const NoiseSettings& settings) {
    const Frame frame{data};
    Image stars(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
    Image noise = stars;
    for_each_pixel(data, [&](int x, int y) {
        stars[frame.index(x, y)] = star_noise_at(frame, x, y, settings);
    });
    for_each_pixel(data, [&](int x, int y) {
        const bool is_unknown = luminance_of(data.samples, x, y) == 0;
        const bool is_to_fill = is_unknown && luminance_of(data.unshadowed, x, y) > 0;
        noise[frame.index(x, y)] = is_to_fill ? 1.0 : boxed(frame, stars, x, y);
    });
    return noise;
}

std::array<Image, 6> reference_filter(const TestFrame& data, const FilterSettings& settings) {
    const Frame frame{data};
    Six images;
    images.fill(
        Image(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height)));
    for_each_pixel(data, [&](int x, int y) {
        for (std::size_t c = 0; c < 3; ++c) {
            images[c][frame.index(x, y)] = data.shadowed[c].at(x, y);
            images[c + 3][frame.index(x, y)] = data.samples[c].at(x, y);
        }
    });
    for (const bool is_row : {true, false}) {
        Six out = images;
        for_each_pixel(data, [&](int x, int y) {
            const auto values = filtered_at(frame, images, x, y, is_row, settings);
            for (std::size_t c = 0; c < 6; ++c) out[c][frame.index(x, y)] = values[c];
        });
        images = std::move(out);
    }
    return images;
}

}  // namespace penumbra::denoise::tests
