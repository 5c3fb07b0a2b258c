#include "core/image/decode.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "core/error.h"
#include "core/image/exr.h"
#include "core/image/file_reader.h"
#include "core/image/srgb.h"
#include "core/image/zlib_stream.h"
#include "tests/core/image_testing.h"

using namespace penumbra;
using namespace penumbra::image;

namespace {

using Bytes = std::vector<std::uint8_t>;

// ---- a PNG writer of its own: stored deflate blocks, no filter, any colour type
// ------------------

void append_big(Bytes& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) {
        bytes.push_back(static_cast<std::uint8_t>(value >> shift));
    }
}

void append_chunk(Bytes& png, std::string_view type, const Bytes& data) {
    append_big(png, static_cast<std::uint32_t>(data.size()));
    const std::size_t begin = png.size();
    png.insert(png.end(), type.begin(), type.end());
    png.insert(png.end(), data.begin(), data.end());
    append_big(png, crc32(std::span(png).subspan(begin)));
}

Bytes zlib_stored(const Bytes& raw) {
    Bytes out{0x78, 0x01, 0x01};
    for (const std::size_t part : {raw.size(), ~raw.size()}) {
        out.push_back(static_cast<std::uint8_t>(part));
        out.push_back(static_cast<std::uint8_t>(part >> 8));
    }
    out.insert(out.end(), raw.begin(), raw.end());
    std::uint32_t a = 1, b = 0;
    for (const std::uint8_t byte : raw) {
        a = (a + byte) % 65521;
        b = (b + a) % 65521;
    }
    append_big(out, b << 16 | a);
    return out;
}

struct PngKind {
    std::uint8_t depth, color_type;
    int channels;
};

// `samples` in the file's order and byte order, row after row.
Bytes make_png(int width, int height, PngKind kind, const Bytes& samples) {
    Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    Bytes header;
    append_big(header, static_cast<std::uint32_t>(width));
    append_big(header, static_cast<std::uint32_t>(height));
    header.insert(header.end(), {kind.depth, kind.color_type, 0, 0, 0});
    append_chunk(png, "IHDR", header);
    Bytes raw;
    const std::size_t row = samples.size() / static_cast<std::size_t>(height);
    for (std::size_t at = 0; at < samples.size(); at += row) {
        raw.push_back(0);
        raw.insert(raw.end(), samples.begin() + static_cast<std::ptrdiff_t>(at),
                   samples.begin() + static_cast<std::ptrdiff_t>(at + row));
    }
    append_chunk(png, "IDAT", zlib_stored(raw));
    append_chunk(png, "IEND", {});
    return png;
}

Bytes random_bytes(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    Bytes bytes(count);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next());
    return bytes;
}

void append(Bytes& bytes, std::initializer_list<std::uint8_t> more) {
    for (const std::uint8_t byte : more) bytes.push_back(byte);
}

// A grey 16 x 8 JPEG of two blocks, written by hand: quantisation 1, a Huffman table with the DC
// sizes 0 and 5 and the AC end of block; the blocks' DC differences are 0 and +16 (2 grey steps).
Bytes small_jpeg() {
    Bytes jpeg;
    append(jpeg, {0xFF, 0xD8, 0xFF, 0xDB, 0, 67, 0});
    for (int i = 0; i < 64; ++i) jpeg.push_back(1);
    append(jpeg, {0xFF, 0xC0, 0, 11, 8, 0, 8, 0, 16, 1, 1, 0x11, 0});
    // Codes of 1 bit: "0" means size 0; of 2 bits: "10" means size 5.
    append(jpeg, {0xFF, 0xC4, 0, 21, 0x00, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 5});
    append(jpeg, {0xFF, 0xC4, 0, 20, 0x10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    append(jpeg, {0xFF, 0xDA, 0, 8, 1, 1, 0x00, 0, 63, 0});
    // DC 0, AC end; DC size 5 with bits 10000 (16), AC end; ones to fill: 0 0 10 10000 0 111111.
    append(jpeg, {0b00101000, 0b00111111, 0xFF, 0xD9});
    return jpeg;
}

Bytes radiance_header(int width, int height) {
    const std::string text = "#?RADIANCE\nSOFTWARE=test\nFORMAT=32-bit_rle_rgbe\n\n-Y " +
                             std::to_string(height) + " +X " + std::to_string(width) + "\n";
    return {text.begin(), text.end()};
}

// Rows of the newer run-length code: per component one run of `width` and no copies, or only
// copies.
Bytes radiance_rows(int width, int height) {
    Bytes hdr = radiance_header(width, height);
    for (int y = 0; y < height; ++y) {
        hdr.insert(hdr.end(),
                   {2, 2, static_cast<std::uint8_t>(width >> 8), static_cast<std::uint8_t>(width)});
        for (int component = 0; component < 4; ++component) {
            if (component == 3) {
                hdr.push_back(static_cast<std::uint8_t>(128 + width));
                hdr.push_back(129);
                continue;
            }
            hdr.push_back(static_cast<std::uint8_t>(width));
            for (int x = 0; x < width; ++x) {
                hdr.push_back(static_cast<std::uint8_t>(10 * component + x + 3 * y));
            }
        }
    }
    return hdr;
}

DecodedImage decode(const Bytes& content) {
    return decode_image(content, "image");
}

void expect_refused(const Bytes& content, const std::string& what) {
    CHECK_THROWS_WITH_AS((void)decode(content), doctest::Contains(what.c_str()), InputError);
}

void expect_all_cuts_refused(const Bytes& whole) {
    int accepted = 0;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        try {
            (void)decode({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)});
            ++accepted;
        } catch (const InputError&) {
        }
    }
    CHECK(accepted == 0);
}

void survive_mutations(const Bytes& whole, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
        try {
            (void)decode(mutate(whole, i));
        } catch (const InputError&) {
        }
    }
}

}  // namespace

TEST_CASE("a PNG of every colour type and depth gives back its samples") {
    for (const PngKind kind : {PngKind{8, 0, 1}, {8, 4, 2}, {8, 2, 3}, {8, 6, 4}}) {
        const Bytes samples = random_bytes(std::size_t{7} * 5 * kind.channels, 1);
        const DecodedImage image = decode(make_png(7, 5, kind, samples));
        CHECK(image.width == 7);
        CHECK(image.height == 5);
        CHECK(image.channels == kind.channels);
        CHECK(image.type == SampleType::kUint8);
        CHECK(image.bytes == samples);
    }
}

TEST_CASE("a PNG of 16 bits keeps all of them") {
    for (const PngKind kind : {PngKind{16, 0, 1}, {16, 4, 2}, {16, 2, 3}, {16, 6, 4}}) {
        const Bytes samples = random_bytes(std::size_t{2} * 6 * 4 * kind.channels, 2);
        const DecodedImage image = decode(make_png(6, 4, kind, samples));
        CHECK(image.type == SampleType::kUint16);
        REQUIRE(image.words.size() * 2 == samples.size());
        int different = 0;
        for (std::size_t i = 0; i < image.words.size(); ++i) {
            different += image.words[i] != (samples[2 * i] << 8 | samples[2 * i + 1]);
        }
        CHECK(different == 0);
    }
}

TEST_CASE("a JPEG gives its pixels") {
    const DecodedImage image = decode(small_jpeg());
    REQUIRE(image.width == 16);
    REQUIRE(image.height == 8);
    CHECK(image.channels == 1);
    CHECK(image.bytes[0] == 128);
    CHECK(image.bytes[15] == 130);
}

TEST_CASE("a Radiance file gives its pixels, in all three of its codes") {
    const DecodedImage coded = decode(radiance_rows(20, 3));
    REQUIRE(coded.sample_count() == 180);
    // Exponent 129 with mantissa m is m / 256 * 2.
    CHECK(coded.floats[3 * (20 * 2 + 4) + 1] == (10 + 4 + 6) / 128.0f);
    Bytes flat = radiance_header(2, 1);
    flat.insert(flat.end(), {128, 64, 0, 128, 1, 2, 3, 0});
    CHECK(decode(flat).floats == std::vector<float>{0.5f, 0.25f, 0, 0, 0, 0});
    Bytes old = radiance_header(300, 1);
    old.insert(old.end(), {255, 0, 0, 136, 1, 1, 1, 43, 1, 1, 1, 1});
    const DecodedImage repeated = decode(old);
    CHECK(repeated.floats[0] == 255);
    CHECK(repeated.floats[3 * 299] == 255);
}

TEST_CASE("an EXR texture is placed in its display window, from the layer that has colours") {
    const TemporaryFolder folder;
    Plane<float> plane(3, 2);
    plane.fill(0.5f);
    ExrImage exr;
    exr.display = {0, 0, 5, 4};
    exr.data = {1, 1, 4, 3};
    for (const char* name : {"depth.Z", "key.B", "key.G", "key.R"}) {
        exr.channels.push_back({name, ExrType::kHalf, plane.view(), {}});
    }
    write_exr(folder / "a.exr", exr, 1);
    const DecodedImage image = decode_image(folder / "a.exr");
    REQUIRE(image.width == 5);
    REQUIRE(image.height == 4);
    CHECK(image.channels == 3);
    CHECK(image.sample(0, 1, 0) == 0);
    CHECK(image.sample(1, 1, 0) == 0.5f);
    CHECK(image.sample(3, 2, 2) == 0.5f);
    CHECK(image.sample(4, 2, 2) == 0);
}

TEST_CASE("the content of an image decides, not its name") {
    const TemporaryFolder folder;
    write_bytes(folder / "a.exr", make_png(1, 1, {8, 0, 1}, {77}));
    CHECK(decode_image(folder / "a.exr").bytes == Bytes{77});
}

TEST_CASE("images that are too large are refused before memory is asked for") {
    expect_refused(make_png(40000, 10, {8, 0, 1}, Bytes(10)), "at most 32768");
    expect_refused(make_png(32768, 32768, {16, 6, 4}, Bytes(32768)), "2048 MiB");
    expect_refused(make_png(20000, 20000, {8, 2, 3}, Bytes(20000)), "do not fit into");
    expect_refused(make_png(0, 10, {8, 0, 1}, Bytes(10)), "empty");
    Bytes jpeg = small_jpeg();
    jpeg[76] = jpeg[78] = 0x7F;  // height and width
    expect_refused(jpeg, "do not fit into");
    expect_refused(radiance_header(30000, 30000), "at most 32768");
    expect_refused(radiance_header(10000, 10000), "cut off");
}

TEST_CASE("what is no image says what would be one") {
    expect_refused({}, "is empty");
    expect_refused({'B', 'M', 0, 0, 0, 0, 0, 0, 0, 0}, "PNG, JPEG, Radiance HDR or EXR");
    // The header of a TGA: 18 bytes that make some readers allocate gigabytes.
    expect_refused({0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0x7F, 0xFF, 0x7F, 24, 0},
                   "not an image of a known format");
    expect_refused(make_png(2, 2, {3, 2, 3}, Bytes(12)), "does not exist");
    Bytes damaged = make_png(4, 4, {8, 0, 1}, Bytes(16));
    damaged[45] ^= 1;
    expect_refused(damaged, "checksum");
    Bytes arithmetic = small_jpeg();
    arithmetic[72] = 0xC9;
    expect_refused(arithmetic, "baseline or progressive");
}

TEST_CASE("images cut off anywhere are refused") {
    expect_all_cuts_refused(make_png(5, 4, {8, 2, 3}, random_bytes(60, 4)));
    expect_all_cuts_refused(small_jpeg());
    expect_all_cuts_refused(radiance_rows(20, 3));
}

TEST_CASE("mutated images give an error or an image, and nothing worse") {
    survive_mutations(small_jpeg(), 600);
    survive_mutations(radiance_rows(20, 3), 600);
    survive_mutations(make_png(5, 4, {8, 2, 3}, random_bytes(60, 5)), 300);
}

TEST_CASE("mutated PNG data behind right checksums give an error or an image") {
    const Bytes raw = zlib_stored(random_bytes(64, 6));
    for (std::uint64_t i = 0; i < 300; ++i) {
        Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
        append_chunk(png, "IHDR",
                     {0, 0, 0, 5, 0, 0, 0, 4, 8, static_cast<std::uint8_t>(i % 7), 0, 0,
                      static_cast<std::uint8_t>(i % 2)});
        if (i % 3 == 0) append_chunk(png, "PLTE", random_bytes(i % 20, i));
        if (i % 4 == 0) append_chunk(png, "tRNS", random_bytes(i % 9, i));
        append_chunk(png, "IDAT", i % 2 == 0 ? mutate(raw, i) : random_bytes(70, i));
        append_chunk(png, "IEND", {});
        try {
            (void)decode(png);
        } catch (const InputError&) {
        }
    }
}

TEST_CASE("an image is grey if its channels are equal, up to JPEG's errors") {
    CHECK(is_grey(decode(make_png(2, 1, {8, 0, 1}, {3, 200}))));
    CHECK(is_grey(decode(make_png(2, 1, {8, 2, 3}, {3, 3, 3, 200, 204, 199}))));
    CHECK_FALSE(is_grey(decode(make_png(2, 1, {8, 2, 3}, {3, 3, 3, 128, 128, 255}))));
    CHECK(is_grey(decode(make_png(1, 1, {8, 6, 4}, {9, 9, 9, 255}))));
}

TEST_CASE("the sRGB curve is exact in both directions") {
    int different = 0;
    for (int code = 0; code < 256; ++code) {
        const double linear = linear_from_srgb(code / 255.0);
        different += srgb8_from_linear(static_cast<float>(linear)) != code;
        different += linear16_from_srgb8()[static_cast<std::size_t>(code)] !=
                     static_cast<int>(std::floor(linear * 65535 + 0.5));
    }
    CHECK(different == 0);
    for (int i = 0; i <= 200000; ++i) {
        const float x = static_cast<float>(i) / 200000;
        const double exact = 255 * srgb_from_linear(x);
        different += std::fabs(srgb8_from_linear(x) - exact) > 0.5 + 1e-4;
    }
    CHECK(different == 0);
    CHECK(linear_from_srgb(0.5) == doctest::Approx(0.21404114).epsilon(1e-7));
    CHECK(srgb8_from_linear(std::nanf("")) == 0);
    CHECK(srgb8_from_linear(-3) == 0);
    CHECK(srgb8_from_linear(7) == 255);
}
