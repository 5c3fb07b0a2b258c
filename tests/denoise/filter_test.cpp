#include <doctest/doctest.h>

#include "denoise/estimator.h"
#include "tests/denoise/reference_chain.h"
#include "tests/lanes_agree.h"

namespace penumbra::denoise::tests {
namespace {

void set_noise(TestFrame& frame, float noise) {
    frame.noise.fill(noise);
}

// Light of any size: 60 binary orders of magnitude, dark and unlearned pixels among them.
void set_wild_light(TestFrame& frame) {
    for_each_pixel(frame, [&](int i, int j) {
        for (std::size_t c = 0; c < 3; ++c) {
            const auto salt = static_cast<std::uint32_t>(10 * c);
            const float scale = std::exp2(60 * (unit_random(i, j, salt + 11) - 0.5f));
            const float light =
                unit_random(i, j, 12) < 0.1f ? 0.0f : scale * (1 + unit_random(i, j, salt + 13));
            const float kind = unit_random(i, j, salt + 14);
            frame.samples[c].at(i, j) = light;
            frame.shadowed[c].at(i, j) = kind < 0.6f   ? light
                                         : kind < 0.7f ? 0.0f
                                                       : light * unit_random(i, j, salt + 15);
        }
    });
}

TEST_CASE("the filter agrees with its definition in double") {
    for (const int radius : {10, 3, kMaxFilterRadius}) {
        TestFrame frame = make_test_frame(171, 99);
        const Settings settings{.noise = {}, .filter = {.radius = radius}};
        run_noise(frame, settings, {});
        const std::array<Image, 6> expected = reference_filter(frame, settings.filter);
        run_filter(frame, settings, {});
        double worst = 0;
        for_each_pixel(frame, [&](int i, int j) {
            for (std::size_t c = 0; c < 3; ++c) {
                const auto index = static_cast<std::size_t>(j * 171 + i);
                worst = std::max(
                    worst, std::fabs(frame.filtered_shadowed[c].at(i, j) - expected[c][index]));
                worst = std::max(
                    worst, std::fabs(frame.filtered_samples[c].at(i, j) - expected[c + 3][index]));
            }
        });
        CHECK(worst < 2e-4);
    }
}

TEST_CASE("the chain has the same bits for every number of lanes and every band") {
    TestFrame frame = make_test_frame(300, 140);
    run_chain(frame);
    penumbra::tests::for_each_isa([&](simd::Isa isa) {
        for (const int band_height : {1, 23, 64, 1000}) {
            TestFrame other = make_test_frame(300, 140);
            run_chain(other, {}, {isa, band_height});
            CHECK(count_differences(frame, frame.beauty, other.beauty) == 0);
            CHECK(count_differences(frame, frame.filtered_shadowed, other.filtered_shadowed) == 0);
            CHECK(count_differences(frame, frame.filtered_samples, other.filtered_samples) == 0);
        }
    });
}

TEST_CASE("lit pixels are emission + U to the last bit, whatever the noise") {
    TestFrame frame = make_test_frame(200, 120);
    set_wild_light(frame);
    for_each_pixel(frame, [&](int i, int j) {
        frame.noise.at(i, j) = unit_random(i, j, 21);
        for (std::size_t c = 0; c < 3; ++c) frame.shadowed[c].at(i, j) = frame.samples[c].at(i, j);
    });
    run_filter(frame, {}, {});
    CHECK(count_differences(frame, frame.filtered_shadowed, frame.filtered_samples) == 0);
    for_each_pixel(frame, [&](int i, int j) {
        for (std::size_t c = 0; c < 3; ++c) {
            REQUIRE(frame.ratio[c].at(i, j) == 1.0f);
            REQUIRE(same_bits(frame.beauty[c].at(i, j),
                              frame.emission[c].at(i, j) + frame.unshadowed[c].at(i, j)));
        }
    });
}

TEST_CASE("the filter keeps 0 <= S_N <= U_N exactly, so that W needs no clamp") {
    TestFrame frame = make_test_frame(256, 128);
    set_wild_light(frame);
    set_noise(frame, 1.0f);
    run_filter(frame, {}, {});
    for_each_pixel(frame, [&](int i, int j) {
        for (std::size_t c = 0; c < 3; ++c) {
            const float s = frame.filtered_shadowed[c].at(i, j);
            const float u = frame.filtered_samples[c].at(i, j);
            REQUIRE(std::isfinite(u));
            REQUIRE(s >= 0.0f);
            REQUIRE(s <= u);
            REQUIRE(raw_shadow_ratio(s, u) <= 1.0f);
        }
    });
}

TEST_CASE("constants pass the filter bit-unchanged") {
    TestFrame frame = make_test_frame(160, 90);
    const float constants[3] = {0.3f, 1e-20f, 12345.678f};
    for_each_pixel(frame, [&](int i, int j) {
        frame.noise.at(i, j) = unit_random(i, j, 31);
        for (std::size_t c = 0; c < 3; ++c) {
            frame.samples[c].at(i, j) = constants[c];
            frame.shadowed[c].at(i, j) = constants[c] * 0.37f;
        }
    });
    run_filter(frame, {}, {});
    for_each_pixel(frame, [&](int i, int j) {
        for (std::size_t c = 0; c < 3; ++c) {
            REQUIRE(same_bits(frame.filtered_samples[c].at(i, j), constants[c]));
            REQUIRE(same_bits(frame.filtered_shadowed[c].at(i, j), constants[c] * 0.37f));
        }
    });
}

TEST_CASE("pixels without noise pass unchanged next to pixels with noise") {
    TestFrame frame = make_test_frame(128, 80);
    const TestFrame before = make_test_frame(128, 80);
    for_each_pixel(
        frame, [&](int i, int j) { frame.noise.at(i, j) = (i / 5 + j / 3) % 2 ? 1.0f : 0.02f; });
    run_filter(frame, {}, {});
    int changed = 0;
    for_each_pixel(frame, [&](int i, int j) {
        const bool is_same =
            same_bits(frame.filtered_samples[1].at(i, j), before.samples[1].at(i, j));
        if (frame.noise.at(i, j) < 0.5f) REQUIRE(is_same);
        changed += !is_same;
    });
    CHECK(changed > 1000);
}

TEST_CASE(
    "where nothing was learned the neighbours decide, and W = 1 only if they know nothing either") {
    TestFrame frame = make_test_frame(192, 128);
    for_each_pixel(frame, [&](int i, int j) {
        const bool is_gap = std::abs(i - 96) <= 20 && std::abs(j - 64) <= 20;
        frame.depth.at(i, j) = 5;
        for (std::size_t c = 0; c < 3; ++c) {
            frame.normal[c].at(i, j) = c == 0 ? 0.0f : c == 1 ? 0.28f : 0.96f;  // faces the camera
            frame.unshadowed[c].at(i, j) = 1;
            frame.samples[c].at(i, j) = is_gap ? 0.0f : 0.8f;
            frame.shadowed[c].at(i, j) = is_gap ? 0.0f : 0.2f;
        }
    });
    run_chain(frame);
    const int reach = 10;
    for_each_pixel(frame, [&](int i, int j) {
        const bool is_beyond_reach =
            std::abs(i - 96) <= 20 - reach && std::abs(j - 64) <= 20 - reach;
        REQUIRE(frame.ratio[0].at(i, j) ==
                doctest::Approx(is_beyond_reach ? 1.0 : 0.25).epsilon(1e-5));
    });
}

TEST_CASE("shadows do not cross from one surface to another") {
    TestFrame frame = make_test_frame(200, 140);
    set_noise(frame, 1.0f);
    const auto is_wall = [&](int i, int j) { return frame.normal[2].at(i, j) > 0.5f; };
    for_each_pixel(frame, [&](int i, int j) {
        for (std::size_t c = 0; c < 3; ++c) {
            frame.samples[c].at(i, j) = 1;
            frame.shadowed[c].at(i, j) = is_wall(i, j) ? 1.0f : 0.0f;
        }
    });
    run_filter(frame, {}, {});
    int walls = 0;
    for_each_pixel(frame, [&](int i, int j) {
        if (frame.depth.at(i, j) >= kDepthOfNothing) return;
        REQUIRE(frame.ratio[0].at(i, j) == (is_wall(i, j) ? 1.0f : 0.0f));
        walls += is_wall(i, j);
    });
    CHECK(walls > 1000);
}

TEST_CASE("a slanted floor is filtered as a wall is: the weights follow its plane") {
    TestFrame frame = make_test_frame(200, 140);
    set_noise(frame, 1.0f);
    run_filter(frame, {}, {});
    const TestFrame before = make_test_frame(200, 140);
    // Far down the floor, where depth changes much from row to row: 15 x 15 random values average.
    double deviation_before = 0, deviation_after = 0;
    for (int j = 100; j < 130; ++j)
        for (int i = 50; i < 150; ++i) {
            deviation_before += std::pow(before.samples[0].at(i, j) - 0.68, 2);
            deviation_after += std::pow(frame.filtered_samples[0].at(i, j) - 0.68, 2);
        }
    CHECK(deviation_after < 0.03 * deviation_before);
}

TEST_CASE("a scene in millimetres and a thousand times dimmer has the same W") {
    TestFrame metres = make_test_frame(180, 110);
    TestFrame millimetres = make_test_frame(180, 110);
    millimetres.camera.eye = millimetres.camera.eye * 1000.0f;
    for_each_pixel(millimetres, [&](int i, int j) {
        if (millimetres.depth.at(i, j) < kDepthOfNothing) millimetres.depth.at(i, j) *= 1000;
        for (std::size_t c = 0; c < 3; ++c) {
            millimetres.shadowed[c].at(i, j) *= 1e-3f;
            millimetres.samples[c].at(i, j) *= 1e-3f;
            millimetres.unshadowed[c].at(i, j) *= 1e-3f;
        }
    });
    run_chain(metres);
    run_chain(millimetres);
    double worst = 0;
    for_each_pixel(metres, [&](int i, int j) {
        for (std::size_t c = 0; c < 3; ++c)
            worst = std::max(worst, std::fabs(static_cast<double>(metres.ratio[c].at(i, j)) -
                                              millimetres.ratio[c].at(i, j)));
    });
    CHECK(worst < 1e-3);  // the noise estimate's square root amplifies rounding
}

// The smallest window of whole tiles that holds `crop` and the chain's margins.
PixelRect window_around(const PixelRect& crop, const Settings& settings, int width, int height) {
    const Margin margin = chain_margin(settings.noise, settings.filter);
    const auto down = [](int n) { return std::max(n, 0) / kTileSize * kTileSize; };
    return {down(crop.x0 - margin.x), down(crop.y0 - margin.y), std::min(crop.x1 + margin.x, width),
            std::min(crop.y1 + margin.y, height)};
}

TEST_CASE("a crop has the bits of its part of the full frame") {
    const Settings settings;
    TestFrame full = make_test_frame(420, 330);
    run_chain(full, settings);
    for (const PixelRect crop :
         {PixelRect{200, 160, 260, 200}, PixelRect{0, 0, 30, 30}, PixelRect{390, 300, 420, 330}}) {
        const PixelRect window = window_around(crop, settings, 420, 330);
        TestFrame part = make_test_frame({420, 330, window});
        run_chain(part, settings);
        int differences = 0;
        for (int y = crop.y0; y < crop.y1; ++y)
            for (int x = crop.x0; x < crop.x1; ++x)
                for (std::size_t c = 0; c < 3; ++c)
                    differences += !same_bits(full.beauty[c].at(x, y),
                                              part.beauty[c].at(x - window.x0, y - window.y0));
        CHECK(differences == 0);
    }
}

TEST_CASE("what lies in the planes beyond the frame changes nothing") {
    TestFrame clean = make_test_frame(130, 70);
    TestFrame dirty = make_test_frame(130, 70);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 192; ++x) {
            if (x < 130 && y < 70) continue;
            // A surface that continues that of the frame, with light of its own.
            set_surface(dirty, x, y, x, y);
            for (std::size_t c = 0; c < 3; ++c) {
                dirty.samples[c].at(x, y) = 1 + unit_random(x, y, 41);
                dirty.shadowed[c].at(x, y) = unit_random(x, y, 42);
                dirty.unshadowed[c].at(x, y) = 1;
            }
        }
    run_chain(clean);
    run_chain(dirty);
    CHECK(count_differences(clean, clean.beauty, dirty.beauty) == 0);
}

}  // namespace
}  // namespace penumbra::denoise::tests
