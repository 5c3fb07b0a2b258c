#include "core/scene/texture.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/image/decode.h"
#include "core/image/png.h"
#include "core/image/srgb.h"
#include "tests/core/image_testing.h"

using namespace penumbra;
using image::DecodedImage;
using image::SampleType;

namespace {

DecodedImage random_image(int width, int height, int channels, std::uint64_t seed) {
    Random random(seed);
    DecodedImage image{width, height, channels, SampleType::kUint8, {}, {}, {}};
    image.bytes.resize(image.sample_count());
    for (std::uint8_t& byte : image.bytes) byte = static_cast<std::uint8_t>(random.next());
    return image;
}

DecodedImage image_of(int width, int height, int channels, std::vector<std::uint8_t> bytes) {
    return {width, height, channels, SampleType::kUint8, std::move(bytes), {}, {}};
}

LoadedTexture make(const DecodedImage& image, const TextureRequest& request) {
    return make_texture(image, "texture", request);
}

// The mean of one channel of a level over [x0, x1) x [y0, y1), in texels with fractions: areas, in
// double.
double mean_over(const Texture& texture, int level, int channel, const double (&box)[4]) {
    const Texture::Level& size = texture.levels[static_cast<std::size_t>(level)];
    double sum = 0, area = 0;
    for (int y = 0; y < size.height; ++y) {
        const double high = std::min(box[3], y + 1.0) - std::max(box[1], static_cast<double>(y));
        for (int x = 0; x < size.width && high > 0; ++x) {
            const double wide =
                std::min(box[2], x + 1.0) - std::max(box[0], static_cast<double>(x));
            if (wide <= 0) continue;
            const Texel at = texel(texture, level, x, y);
            const float values[] = {at.r, at.g, at.b, at.a};
            sum += wide * high * values[channel];
            area += wide * high;
        }
    }
    return sum / area;
}

// The largest deviation of any level from the box filter of the one before, in 16-bit steps. Both
// are rounded, so one step is the best there is.
double largest_error(const Texture& texture) {
    double worst = 0;
    for (int level = 1; level < static_cast<int>(texture.levels.size()); ++level) {
        const auto& fine = texture.levels[static_cast<std::size_t>(level) - 1];
        const auto& coarse = texture.levels[static_cast<std::size_t>(level)];
        const double sx = static_cast<double>(fine.width) / coarse.width;
        const double sy = static_cast<double>(fine.height) / coarse.height;
        for (int y = 0; y < coarse.height; ++y) {
            for (int x = 0; x < coarse.width; ++x) {
                const Texel at = texel(texture, level, x, y);
                const float values[] = {at.r, at.g, at.b, at.a};
                const double box[] = {x * sx, y * sy, (x + 1) * sx, (y + 1) * sy};
                for (int c = 0; c < 4; ++c) {
                    const double error = values[c] - mean_over(texture, level - 1, c, box);
                    worst = std::max(worst, 65535 * std::fabs(error));
                }
            }
        }
    }
    return worst;
}

}  // namespace

TEST_CASE(
    "a mip chain halves to one texel and each level is the exact box filter of the one before") {
    for (const auto& [width, height] : {std::pair{1, 1},
                                        {2, 2},
                                        {3, 3},
                                        {5, 1},
                                        {1, 7},
                                        {16, 4},
                                        {17, 11},
                                        {31, 64},
                                        {100, 37}}) {
        const DecodedImage image = random_image(width, height, 3, 1);
        for (const TextureKind kind : {TextureKind::kColor, TextureKind::kData}) {
            const Texture texture = make(image, {.kind = kind}).texture;
            int w = width, h = height;
            for (const Texture::Level& level : texture.levels) {
                CHECK(level.width == w);
                CHECK(level.height == h);
                w = std::max(1, w / 2);
                h = std::max(1, h / 2);
            }
            CHECK(texture.levels.back().width == 1);
            CHECK(texture.levels.back().height == 1);
            CHECK(largest_error(texture) <= 1.01);
        }
    }
}

TEST_CASE("the last texel is the mean of the linear image, also for odd sizes") {
    const DecodedImage image = random_image(101, 77, 1, 2);
    double sum = 0;
    for (const std::uint8_t byte : image.bytes) sum += image::linear_from_srgb(byte / 255.0);
    const Texture texture = make(image, {}).texture;
    const Texel last = texel(texture, static_cast<int>(texture.levels.size()) - 1, 0, 0);
    CHECK(last.r == doctest::Approx(sum / image.bytes.size()).epsilon(3e-5));
}

TEST_CASE("levels lie one after the other and rows begin at the top") {
    const Texture texture =
        make(image_of(2, 2, 1, {0, 64, 128, 255}), {.kind = TextureKind::kData}).texture;
    CHECK(texture.levels[1].offset == 8);
    CHECK(texture.texels.size() == 10);
    CHECK((texture.texels[2] & 0xFFFF) == 64 * 257);
    CHECK((texture.texels[4] >> 16) == 128 * 257);
    const std::uint32_t white = 255u * 257u;
    CHECK(texture.texels[7] == (white | white << 16));
}

TEST_CASE("colours of 8 bits are sRGB, deeper ones and data are linear") {
    DecodedImage image = image_of(1, 1, 3, {10, 128, 250});
    const auto coded = [&](int c) { return image.bytes[static_cast<std::size_t>(c)] / 255.0; };
    const Texel color = texel(make(image, {}).texture, 0, 0, 0);
    CHECK(std::fabs(color.r - image::linear_from_srgb(coded(0))) < 0.51 / 65535);
    CHECK(std::fabs(color.g - image::linear_from_srgb(coded(1))) < 0.51 / 65535);
    CHECK(std::fabs(color.b - image::linear_from_srgb(coded(2))) < 0.51 / 65535);
    CHECK(color.a == 1);
    const Texel data = texel(make(image, {.kind = TextureKind::kData}).texture, 0, 0, 0);
    CHECK(data.g == doctest::Approx(coded(1)));
    DecodedImage deep{1, 1, 1, SampleType::kUint16, {}, {12345}, {}};
    CHECK(texel(make(deep, {}).texture, 0, 0, 0).r == 12345.0f / 65535.0f);
}

TEST_CASE("values that a texel cannot hold are clamped and counted") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const DecodedImage image{4, 1, 1, SampleType::kFloat, {}, {}, {0.5f, 7.0f, -1.0f, nan}};
    const LoadedTexture loaded = make(image, {});
    CHECK(loaded.clamped_texels == 3);
    const float expected[] = {0.5f, 1, 0, 0};
    for (int x = 0; x < 4; ++x) {
        CHECK(std::fabs(texel(loaded.texture, 0, x, 0).r - expected[x]) < 1e-5f);
    }
}

TEST_CASE("a packed map gives the channel that is asked for") {
    const DecodedImage image = image_of(1, 1, 4, {10, 20, 30, 40});
    for (int channel = 0; channel < 4; ++channel) {
        const TextureRequest request{.kind = TextureKind::kData, .channel = channel};
        const Texel at = texel(make(image, request).texture, 0, 0, 0);
        CHECK(at.r == doctest::Approx((10 + 10 * channel) / 255.0));
        CHECK(at.b == at.r);
    }
    const TextureRequest alpha{.kind = TextureKind::kData, .channel = 3};
    CHECK_THROWS_AS((void)make(image_of(1, 1, 3, {1, 2, 3}), alpha), InputError);
    const TextureRequest beyond{.kind = TextureKind::kData, .channel = 4};
    CHECK_THROWS_AS((void)make(image, beyond), InputError);
}

TEST_CASE("opacity is the alpha channel, or where that says nothing the luminance") {
    const TextureRequest request{.kind = TextureKind::kOpacity};
    const auto alpha = [&](const DecodedImage& image) {
        return 255 * texel(make(image, request).texture, 0, 0, 0).a;
    };
    CHECK(alpha(image_of(1, 1, 4, {200, 200, 200, 51})) == doctest::Approx(51));
    CHECK(alpha(image_of(1, 1, 4, {200, 200, 200, 255})) == doctest::Approx(200));
    CHECK(alpha(image_of(1, 1, 1, {90})) == doctest::Approx(90));
    CHECK(alpha(image_of(1, 1, 3, {255, 0, 0})) == doctest::Approx(255 * 0.2126).epsilon(1e-4));
    CHECK(make(image_of(1, 1, 2, {9, 0}), request).has_alpha);
    CHECK_FALSE(make(image_of(1, 1, 2, {9, 255}), request).has_alpha);
}

TEST_CASE("what is transparent does not colour what is not") {
    const DecodedImage image = image_of(2, 1, 4, {255, 0, 0, 255, 0, 255, 0, 0});
    const Texture texture = make(image, {}).texture;
    const Texel mixed = texel(texture, 1, 0, 0);
    CHECK(mixed.r == doctest::Approx(1).epsilon(1e-4));
    CHECK(mixed.g == doctest::Approx(0).epsilon(1e-4));
    CHECK(mixed.a == doctest::Approx(0.5).epsilon(1e-4));
    CHECK(texel(texture, 0, 1, 0).g == doctest::Approx(1).epsilon(1e-4));
}

TEST_CASE("normals have unit length in every level, and point to the mean of their directions") {
    const Texture texture = make(random_image(13, 9, 3, 5), {.kind = TextureKind::kNormal}).texture;
    for (int level = 0; level < static_cast<int>(texture.levels.size()); ++level) {
        const Texel at = texel(texture, level, 0, 0);
        const double x = 2.0 * at.r - 1, y = 2.0 * at.g - 1, z = 2.0 * at.b - 1;
        CHECK(std::fabs(x * x + y * y + z * z - 1) < 1e-4);
    }
    // Leaning left by 45 degrees and upright: the mean leans by 22.5.
    const Texture pair =
        make(image_of(2, 1, 3, {37, 128, 218, 128, 128, 255}), {.kind = TextureKind::kNormal})
            .texture;
    const Texel mean = texel(pair, 1, 0, 0);
    CHECK(std::atan2(1 - 2 * mean.r, 2 * mean.b - 1) ==
          doctest::Approx(22.5 * M_PI / 180).epsilon(0.01));
    const Texture none =
        make(image_of(2, 1, 3, {0, 128, 128, 255, 127, 127}), {.kind = TextureKind::kNormal})
            .texture;
    CHECK(std::isfinite(texel(none, 1, 0, 0).b));
}

TEST_CASE("a height map becomes the normals of its relief, whatever its resolution") {
    for (const int size : {64, 256}) {
        DecodedImage image{size, size, 1, SampleType::kFloat, {}, {}, {}};
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const double u = (x + 0.5) / size, v = 1 - (y + 0.5) / size;
                image.floats.push_back(static_cast<float>(0.5 + 0.25 * std::sin(2 * M_PI * u) +
                                                          0.125 * std::cos(2 * M_PI * v)));
            }
        }
        const TextureRequest request{.kind = TextureKind::kHeight, .relief = 0.5f};
        const Texture texture = make(image, request).texture;
        double worst = 0;
        for (int y = 0; y < size; y += 5) {
            for (int x = 0; x < size; x += 5) {
                const double u = (x + 0.5) / size, v = 1 - (y + 0.5) / size;
                const double du = 0.5 * 0.25 * 2 * M_PI * std::cos(2 * M_PI * u);
                const double dv = -0.5 * 0.125 * 2 * M_PI * std::sin(2 * M_PI * v);
                const double length = std::sqrt(1 + du * du + dv * dv);
                const Texel at = texel(texture, 0, x, y);
                worst = std::max({worst, std::fabs(2 * at.r - 1 + du / length),
                                  std::fabs(2 * at.g - 1 + dv / length),
                                  std::fabs(2 * at.b - 1 - 1 / length)});
            }
        }
        CHECK(worst < 2.0 / size / size * 10 + 1e-4);
    }
}

TEST_CASE("a texture comes from a file, and keeps its name") {
    const TemporaryFolder folder;
    image::write_png(folder / "a.png", {1, 1, 3, {255, 0, 255}});
    const LoadedTexture loaded = load_texture(folder / "a.png", {});
    CHECK(loaded.texture.name == (folder / "a.png").string());
    CHECK(texel(loaded.texture, 0, 0, 0).g == 0);
    CHECK_THROWS_AS((void)load_texture(folder / "b.png", {}), InputError);
}
