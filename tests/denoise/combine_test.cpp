#include <doctest/doctest.h>

#include "denoise/combine_formula.h"
#include "tests/denoise/test_frame.h"
#include "tests/lanes_agree.h"

namespace penumbra::denoise::tests {
namespace {

void run_combine(TestFrame& frame, const Run& run) {
    const TestFrame& in = frame;
    for_each_band(frame, run, [&](const PixelRect& band) {
        combine(frame.window,
                {view(in.shadowed), view(in.samples), view(in.unshadowed), view(in.emission)},
                {view(frame.beauty), view(frame.ratio)}, band, run.isa);
    });
}

TEST_CASE("W is held to [0, 1] and is 1 where nothing was learned") {
    CHECK(shadow_ratio(0.0f, 0.0f) == 1.0f);
    CHECK(shadow_ratio(1.0f, 4.0f) == 0.25f);
    CHECK(shadow_ratio(0.0f, 4.0f) == 0.0f);
    CHECK(shadow_ratio(4.0f, 1.0f) == 1.0f);
    CHECK(shadow_ratio(1e-30f, 1e-30f) == 1.0f);
    CHECK(raw_shadow_ratio(4.0f, 1.0f) == 4.0f);
}

TEST_CASE("the picture is emission + U W, with the same bits for every number of lanes") {
    penumbra::tests::for_each_isa([&](simd::Isa isa) {
        TestFrame frame = make_test_frame(150, 80);
        run_combine(frame, {isa, 19});
        for_each_pixel(frame, [&](int i, int j) {
            for (std::size_t c = 0; c < 3; ++c) {
                const float ratio =
                    shadow_ratio(frame.shadowed[c].at(i, j), frame.samples[c].at(i, j));
                REQUIRE(same_bits(frame.ratio[c].at(i, j), ratio));
                REQUIRE(same_bits(frame.beauty[c].at(i, j),
                                  combined_radiance(frame.emission[c].at(i, j),
                                                    frame.unshadowed[c].at(i, j), ratio)));
            }
        });
    });
}

TEST_CASE("without noise the filter's picture is the plain one") {
    TestFrame plain = make_test_frame(150, 80);
    run_combine(plain, {});
    TestFrame filtered = make_test_frame(150, 80);
    filtered.noise.fill(0.0f);
    run_filter(filtered, {}, {});
    CHECK(count_differences(plain, plain.beauty, filtered.beauty) == 0);
}

}  // namespace
}  // namespace penumbra::denoise::tests
