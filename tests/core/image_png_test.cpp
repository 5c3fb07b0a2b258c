#include "core/image/png.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/image/decode.h"
#include "core/image/srgb.h"
#include "tests/core/image_testing.h"

using namespace penumbra;
using namespace penumbra::image;

namespace {

enum class Content { kConstant, kGradient, kNoise, kRareNoise, kPeriodic };

std::uint8_t sample(Content content, std::size_t i, Random& random) {
    switch (content) {
        case Content::kConstant:
            return 77;
        case Content::kGradient:
            return static_cast<std::uint8_t>(i / 50);
        case Content::kNoise:
            return static_cast<std::uint8_t>(random.next());
        case Content::kRareNoise:
            return random.below(40) == 0 ? 255 : 3;
        case Content::kPeriodic:
            return static_cast<std::uint8_t>(i % 331);
    }
    return 0;
}

Picture make_picture(int width, int height, int channels, Content content) {
    Picture picture{width, height, channels, {}};
    Random random(9);
    const auto count = static_cast<std::size_t>(width) * height * channels;
    for (std::size_t i = 0; i < count; ++i) picture.bytes.push_back(sample(content, i, random));
    return picture;
}

// One pixel through the tone curve.
std::array<int, 3> mapped(float r, float g, float b, ToneMapping mapping) {
    Plane3<float> planes = make_plane3<float>(1, 1);
    planes[0].at(0, 0) = r;
    planes[1].at(0, 0) = g;
    planes[2].at(0, 0) = b;
    const Picture picture = tone_map(view(std::as_const(planes)), 1, 1, mapping);
    return {picture.bytes[0], picture.bytes[1], picture.bytes[2]};
}

}  // namespace

TEST_CASE("a PNG that we write is read back the same") {
    for (const Content content : {Content::kConstant, Content::kGradient, Content::kNoise,
                                  Content::kRareNoise, Content::kPeriodic}) {
        for (const auto& [width, height] :
             {std::pair{1, 1}, {2, 1}, {1, 3}, {61, 47}, {400, 300}}) {
            for (const int channels : {3, 4}) {
                const Picture picture = make_picture(width, height, channels, content);
                const DecodedImage image = decode_image(encode_png(picture), "image");
                CHECK(image.width == width);
                CHECK(image.height == height);
                CHECK(image.channels == channels);
                CHECK(image.bytes == picture.bytes);
            }
        }
    }
}

TEST_CASE("smooth pictures become much smaller than their pixels") {
    const Picture picture = make_picture(400, 300, 3, Content::kConstant);
    CHECK(encode_png(picture).size() < picture.bytes.size() / 100);
    CHECK(encode_png(make_picture(400, 300, 3, Content::kNoise)).size() <
          400 * 300 * 3 * 102 / 100);
}

TEST_CASE("previews show mid-tones as sRGB and roll highlights off") {
    const ToneMapping shoulder{0, ToneCurve::kShoulder};
    const ToneMapping clip{0, ToneCurve::kClip};
    for (const float x : {0.0f, 0.001f, 0.18f, 0.5f, 0.8f}) {
        const int expected = static_cast<int>(std::lround(255 * srgb_from_linear(x)));
        CHECK(mapped(x, 0, 0, shoulder)[0] == expected);
        CHECK(mapped(0, x, 0, clip)[1] == expected);
    }
    CHECK(mapped(1.5f, 0, 0, clip)[0] == 255);
    const std::array<int, 3> high = mapped(1, 2, 4, shoulder);
    CHECK(high[0] < high[1]);
    CHECK(high[1] < high[2]);
    CHECK(high[2] < 255);
    CHECK(high[0] == std::lround(255 * srgb_from_linear(0.9)));
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK(mapped(infinity, -1, 1e30f, shoulder) == std::array{255, 0, 255});
}

TEST_CASE("exposure counts in stops, and NaN is seen") {
    CHECK(mapped(0.1f, 0.2f, 0.05f, {2, ToneCurve::kClip}) ==
          mapped(0.4f, 0.8f, 0.2f, {0, ToneCurve::kClip}));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(mapped(0.1f, nan, 0.2f, {}) == std::array{255, 0, 255});
}
