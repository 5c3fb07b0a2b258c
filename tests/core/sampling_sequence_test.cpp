#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "core/sampling/mis.h"
#include "core/sampling/sequence.h"
#include "tests/core/sampling_lanes.h"

namespace penumbra {
namespace {

FrameContext frame_context(int frame, int pass, std::uint32_t seed) {
    FrameContext context;
    context.frame = frame;
    context.pass = pass;
    context.seed = seed;
    return context;
}

// Does every cell of a grid of 2^bits cells, of each shape, hold exactly one of the 2^bits points?
bool is_net(const std::vector<Vec2f>& points, int bits) {
    for (int x_bits = 0; x_bits <= bits; ++x_bits) {
        const int columns = 1 << x_bits, rows = 1 << (bits - x_bits);
        std::vector<int> hits(points.size(), 0);
        for (const Vec2f& p : points)
            ++hits[static_cast<std::size_t>(static_cast<int>(p.y * static_cast<float>(rows)) *
                                                columns +
                                            static_cast<int>(p.x * static_cast<float>(columns)))];
        for (const int count : hits)
            if (count != 1) return false;
    }
    return true;
}

// Mean squared error of the mean of f over windows of 8 x 8 pixels, anywhere in the frame.
template <class Function, class Points>
double window_error(const Function& f, double expected, const Points& points) {
    constexpr int kSize = 128, kWindow = 8;
    std::vector<double> values(kSize * kSize);
    for (int i = 0; i < kSize * kSize; ++i)
        values[static_cast<std::size_t>(i)] = f(points(i % kSize, i / kSize));
    double error = 0;
    int windows = 0;
    for (int y = 0; y + kWindow <= kSize; y += 3)
        for (int x = 0; x + kWindow <= kSize; x += 3) {
            double sum = 0;
            for (int j = 0; j < kWindow; ++j)
                for (int i = 0; i < kWindow; ++i)
                    sum += values[static_cast<std::size_t>((y + j) * kSize + x + i)];
            error += std::pow(sum / (kWindow * kWindow) - expected, 2);
            ++windows;
        }
    return error / windows;
}

}  // namespace

TEST_CASE("the samples of a pixel are stratified in every way, for all powers of two") {
    for (const int bits : {0, 1, 2, 4, 6})
        for (std::uint32_t pixel = 0; pixel < 50; ++pixel) {
            const Sequence sequence = make_sequence(frame_context(3, 0, 9), 7, 1 << bits);
            std::vector<Vec2f> points;
            for (std::uint32_t sample = 0; sample < (1u << bits); ++sample)
                points.push_back(sequence_point<float>(sequence, 131 * pixel, 77 * pixel, sample));
            CHECK(is_net(points, bits));
        }
}

TEST_CASE("single samples are stratified over aligned squares of pixels") {
    const Sequence sequence = make_sequence(frame_context(1, 0, 0), 0, 1);
    for (const int bits : {1, 2, 3, 4})
        for (std::uint32_t corner = 0; corner < 20; ++corner) {
            std::vector<Vec2f> points;
            for (std::uint32_t i = 0; i < (1u << (2 * bits)); ++i)
                points.push_back(sequence_point<float>(sequence,
                                                       (corner << bits) + (i & ((1u << bits) - 1)),
                                                       (3u << bits) + (i >> bits), 0));
            CHECK(is_net(points, 2 * bits));
        }
}

TEST_CASE("averages over neighbouring pixels err several times less than independent samples") {
    const auto disk = [](Vec2f p) {
        const float dx = p.x - 0.4f, dy = p.y - 0.55f;
        return dx * dx + dy * dy < 0.09f ? 1.0 : 0.0;
    };
    const auto ramp = [](Vec2f p) { return static_cast<double>(p.x * p.y); };
    double ours[2] = {0, 0}, independent[2] = {0, 0};
    for (int frame = 0; frame < 8; ++frame) {
        const Sequence sequence = make_sequence(frame_context(frame, 0, 0), 0, 1);
        const auto points = [&](int x, int y) {
            return sequence_point<float>(sequence, static_cast<std::uint32_t>(x),
                                         static_cast<std::uint32_t>(y), 0);
        };
        const auto white = [&](int x, int y) {
            const auto pixel = static_cast<std::uint32_t>(y * 128 + x);
            const std::uint32_t u = hash_pair(pixel, static_cast<std::uint32_t>(frame));
            return Vec2f{static_cast<float>(u >> 8) * 0x1p-24f,
                         static_cast<float>(hash_bits(u) >> 8) * 0x1p-24f};
        };
        constexpr double kPi = 3.14159265358979;
        ours[0] += window_error(disk, 0.09 * kPi, points);
        ours[1] += window_error(ramp, 0.25, points);
        independent[0] += window_error(disk, 0.09 * kPi, white);
        independent[1] += window_error(ramp, 0.25, white);
    }
    MESSAGE("mean squared error against independent samples: "
            << ours[0] / independent[0] << " and " << ours[1] / independent[1]);
    CHECK(ours[0] < 0.4 * independent[0]);
    CHECK(ours[1] < 0.25 * independent[1]);
}

TEST_CASE("frames, passes, seeds and dimensions give sequences of their own, and always the same") {
    const auto first = [](int frame, int pass, std::uint32_t seed, std::uint32_t dimension) {
        const Sequence s = make_sequence(frame_context(frame, pass, seed), dimension, 4);
        return sequence_point<float>(s, 100, 50, 2);
    };
    const Vec2f reference = first(1, 0, 0, 0);
    CHECK(std::memcmp(&reference, std::make_unique<Vec2f>(first(1, 0, 0, 0)).get(), 8) == 0);
    int same = 0;
    for (int i = 1; i < 200; ++i)
        for (const Vec2f& other : {first(1 + i, 0, 0, 0), first(1, i, 0, 0),
                                   first(1, 0, static_cast<std::uint32_t>(i), 0),
                                   first(1, 0, 0, static_cast<std::uint32_t>(i))})
            same += std::fabs(other.x - reference.x) < 1e-4f;
    CHECK(same < 5);
}

TEST_CASE("different dimensions are independent of each other") {
    const Sequence a = make_sequence(frame_context(1, 0, 0), 0, 1);
    const Sequence b = make_sequence(frame_context(1, 0, 0), 1, 1);
    double sum = 0;
    constexpr int kSize = 256;
    for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
        const Vec2f p = sequence_point<float>(a, i % kSize, i / kSize, 0);
        const Vec2f q = sequence_point<float>(b, i % kSize, i / kSize, 0);
        sum += static_cast<double>((p.x - 0.5f) * (q.x - 0.5f));
    }
    CHECK(std::fabs(12 * sum / (kSize * kSize)) < 0.02);
}

TEST_CASE("sequence and polygon samples have the same bits for float, 8 and 16 lanes") {
    const Vec3f vertices[5] = {
        {1, 0, 0.5f}, {0.5f, 0.8f, 0.6f}, {-0.4f, 0.9f, 1}, {-0.9f, 0, 1}, {0.2f, -0.7f, 0.4f}};
    const Vec3f flat[4] = {{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}};
    for (const bool quad : {false, true}) {
        auto expected = std::make_unique<SampledRow>();
        expected->light =
            quad ? make_polygon_shape(flat, 4) : make_polygon_shape(vertices, 3, true);
        expected->sequence = make_sequence(frame_context(2, 1, 3), 4, 1);
        auto eight = std::make_unique<SampledRow>(*expected);
        auto sixteen = std::make_unique<SampledRow>(*expected);
        for (int i = 0; i < kSampledPixels; ++i) sample_row<float>(*expected, i);
        avx2::sample_whole_row(*eight);
        CHECK(std::memcmp(expected.get(), eight.get(), sizeof(SampledRow)) == 0);
        if (!simd::is_supported(simd::Isa::kAvx512)) continue;
        avx512::sample_whole_row(*sixteen);
        CHECK(std::memcmp(expected.get(), sixteen.get(), sizeof(SampledRow)) == 0);
    }
}

TEST_CASE("the balance heuristic's weights sum to one, and nothing is divided by zero") {
    const float a = balance_factor(6.0f, 0.3f, 2.0f, 1.7f);
    CHECK(6 * 0.3f * a + 2 * 1.7f * a == doctest::Approx(1));
    CHECK(balance_factor(4.0f, 0.0f, 0.0f, 0.0f) == 0);
    for (int samples = 1; samples <= 64; ++samples) {
        const SampleShares shares = share_samples(samples);
        CHECK(shares.light + shares.brdf == samples);
        CHECK((shares.brdf == 0) == (samples <= 4));
    }
}

}  // namespace penumbra
