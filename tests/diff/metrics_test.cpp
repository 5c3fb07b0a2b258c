#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/diff/compare_files.h"
#include "core/image/exr.h"
#include "core/image/png.h"
#include "tests/core/image_testing.h"

// Whole comparisons of files against implementations that are not ours. The values are the output
// of `python3 tests/diff/oracle.py` with flip-evaluator 1.7 and scikit-image 0.26.0; the pictures
// are larger than a tile, so that seams would show.

namespace penumbra {
namespace {

constexpr int kWidth = 300, kHeight = 80;

double noise(std::uint32_t x, std::uint32_t y, std::uint32_t c) {
    std::uint32_t h = (x * 73856093u) ^ (y * 19349663u) ^ ((c + 1) * 83492791u);
    h = (h ^ (h >> 13)) * 1274126177u;
    return ((h >> 16) & 255) / 255.0;
}

double base(int x, int y, int c) {
    return ((x * (5 + c) + y * (3 + 2 * c)) % 64) / 128.0 + noise(static_cast<std::uint32_t>(x / 8),
                                                                  static_cast<std::uint32_t>(y / 8),
                                                                  static_cast<std::uint32_t>(c)) /
                                                                2;
}

double distorted(int kind, int x, int y, int c) {
    const double v = base(x, y, c);
    switch (kind) {
        case 0:
            return v + 0.02;
        case 1:
            return v * 0.8;
        case 2:
            return v + 0.2 * (noise(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                    static_cast<std::uint32_t>(c + 7)) -
                              0.5);
        case 3:
            return base(x + 1, y, c);
        case 4:
            return base(x, y, (c + 1) % 3);
        case 5:
            return (v + base(x + 1, y, c) + base(x, y + 1, c) + base(x + 1, y + 1, c)) / 4;
        case 6:
            return x >= 250 && x < 262 && y >= 60 && y < 70 ? 1.0 : v;
        case 7:
            return 1 - v;
        case 8:
            return std::floor(v * 8) / 8;
        default:
            return (v - 0.5) * 1.5 + 0.5;
    }
}

void write_png(const std::filesystem::path& file, int kind) {
    image::Picture picture{kWidth, kHeight, 3, {}};
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int c = 0; c < 3; ++c) {
                const double v = kind < 0 ? base(x, y, c) : distorted(kind, x, y, c);
                picture.bytes.push_back(
                    static_cast<std::uint8_t>(std::floor(std::clamp(v, 0.0, 1.0) * 255 + 0.5)));
            }
    image::write_png(file, picture);
}

void write_float_exr(const std::filesystem::path& file, int kind) {
    Plane3<float> planes = make_plane3<float>(kWidth, kHeight);
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const double v =
                    std::clamp(kind < 0 ? base(x, y, c) : distorted(kind, x, y, c), 0.0, 1.0);
                planes[static_cast<std::size_t>(c)].at(x, y) =
                    static_cast<float>(20 * std::pow(v, 4));
            }
    image::ExrImage exr{{0, 0, kWidth, kHeight}, {0, 0, kWidth, kHeight}, {}, {}};
    const char* const names[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c)
        exr.channels.push_back({names[c], image::ExrType::kFloat, planes[c].view(), {}});
    image::write_exr(file, exr, 1);
}

struct Expected {
    bool is_hdr;
    int kind;
    double flip, hdr_flip, ssim, psnr, relmse;
};
// clang-format off
constexpr Expected kExpected[] = {
    {false, 0, 0.118946, -1.000000, 0.999017, 33.98062, 0.00320715},
    {false, 1, 0.467401, -1.000000, 0.951920, 19.28275, 0.03687898},
    {false, 2, 0.122142, -1.000000, 0.917401, 24.77978, 0.02456425},
    {false, 3, 0.302492, -1.000000, 0.526517, 15.81999, 0.10608515},
    {false, 4, 0.687845, -1.000000, 0.036084, 10.79942, 0.91924583},
    {false, 5, 0.291140, -1.000000, 0.693507, 18.60359, 0.06324414},
    {false, 6, 0.008138, -1.000000, 0.991669, 28.87556, 0.02138393},
    {false, 7, 0.790704, -1.000000, -0.839114, 7.79101, 2.54729427},
    {false, 8, 0.274968, -1.000000, 0.953786, 22.89285, 0.03776582},
    {false, 9, 0.368105, -1.000000, 0.924842, 21.17161, 0.07727766},
    {true, 0, 0.167141, 0.176845, 0.984226, 28.57840, 0.02788775},
    {true, 1, 0.508003, 0.629880, 0.831653, 15.79244, 0.29507076},
    {true, 2, 0.188127, 0.204786, 0.862512, 19.53633, 0.23776128},
    {true, 3, 0.391571, 0.449706, 0.520228, 12.22226, 5.41921890},
    {true, 4, 0.766374, 0.850574, 0.017115, 7.27870, 249.38290208},
    {true, 5, 0.367915, 0.434572, 0.740190, 15.12150, 0.99610204},
    {true, 6, 0.004864, 0.008215, 0.995038, 32.31619, 25.91187013},
    {true, 7, 0.867760, 0.898165, -0.304428, 5.53459, 1337.00400833},
    {true, 8, 0.391415, 0.402177, 0.832387, 16.75945, 0.16012678},
    {true, 9, 0.286252, 0.371179, 0.928606, 18.47699, 0.26447140},
};
// clang-format on

diff::CompareSettings all_metrics() {
    diff::CompareSettings settings;
    for (const diff::MetricInfo& metric : diff::metric_table()) settings.metrics.add(metric.metric);
    return settings;
}

}  // namespace

TEST_CASE("metrics of 20 pairs agree with independent implementations") {
    const TemporaryFolder folder;
    const parallel::Arena arena(2);
    write_png(folder / "ref.png", -1);
    write_float_exr(folder / "ref.exr", -1);
    for (const Expected& expected : kExpected) {
        CAPTURE(expected.is_hdr);
        CAPTURE(expected.kind);
        const std::string extension = expected.is_hdr ? ".exr" : ".png";
        const auto test = folder / ("test" + extension);
        expected.is_hdr ? write_float_exr(test, expected.kind) : write_png(test, expected.kind);
        const diff::PairReport report =
            diff::compare_files(folder / ("ref" + extension), test, all_metrics(), arena);
        REQUIRE(report.layers.size() == 1);
        const auto value = [&](diff::Metric m) { return report.layers[0].metrics[m].value_or(-1); };
        CHECK(std::abs(value(diff::Metric::kFlip) - expected.flip) < 1e-4);
        CHECK(std::abs(value(diff::Metric::kHdrFlip) - expected.hdr_flip) < 1e-4);
        CHECK(std::abs(value(diff::Metric::kSsim) - expected.ssim) < 1e-4);
        CHECK(std::abs(value(diff::Metric::kPsnr) - expected.psnr) < 1e-3);
        CHECK(std::abs(value(diff::Metric::kRelmse) / expected.relmse - 1) < 1e-4);
    }
}

TEST_CASE("results do not depend on the number of threads") {
    const TemporaryFolder folder;
    write_float_exr(folder / "ref.exr", -1);
    write_float_exr(folder / "test.exr", 2);
    std::vector<diff::PairReport> reports;
    for (const int threads : {1, 2, 7}) {
        const parallel::Arena arena(threads);
        reports.push_back(
            diff::compare_files(folder / "ref.exr", folder / "test.exr", all_metrics(), arena));
    }
    for (const diff::PairReport& report : reports)
        for (const diff::MetricInfo& metric : diff::metric_table())
            CHECK(report.layers[0].metrics[metric.metric] ==
                  reports[0].layers[0].metrics[metric.metric]);
}

}  // namespace penumbra
