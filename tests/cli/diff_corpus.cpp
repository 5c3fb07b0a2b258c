#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/image/exr.h"
#include "core/image/png.h"
#include "tests/cli/diff_corpus_formats.h"

// Usage: diff_corpus: writes the images of tests/cli/diff_test.sh into the current folder.

namespace {

using namespace penumbra;

using Pixels = std::vector<Plane<float>>;
using Change = std::function<void(Pixels&)>;

struct Shape {
    int width = 70, height = 66;
    image::Window display{};  // of no size: as the data window
    int x0 = 0, y0 = 0;
    std::vector<std::string> channels = {"R", "G", "B", "A"};
    image::ExrType type = image::ExrType::kFloat;
    image::ExrCompression compression = image::ExrCompression::kZip;
};

float value(int x, int y, std::size_t channel) {
    return static_cast<float>((x * 7 + y * 5 + static_cast<int>(channel) * 11) % 32) / 32.0f;
}

void write(const std::string& name, const Shape& shape, const Change& change = {}) {
    Pixels pixels;
    for (std::size_t c = 0; c < shape.channels.size(); ++c) {
        pixels.emplace_back(shape.width, shape.height);
        for (int y = 0; y < shape.height; ++y)
            for (int x = 0; x < shape.width; ++x) pixels[c].at(x, y) = value(x, y, c);
    }
    if (change) change(pixels);
    image::ExrImage exr;
    exr.data = {shape.x0, shape.y0, shape.x0 + shape.width, shape.y0 + shape.height};
    exr.display = shape.display.width() > 0 ? shape.display : exr.data;
    exr.compression = shape.compression;
    Plane<std::uint32_t> ids(shape.width, shape.height);
    for (int y = 0; y < shape.height; ++y)
        for (int x = 0; x < shape.width; ++x)
            ids.at(x, y) = static_cast<std::uint32_t>(pixels[0].at(x, y) * 32);
    for (std::size_t c = 0; c < shape.channels.size(); ++c) {
        const bool is_id =
            shape.type == image::ExrType::kUint || shape.channels[c].starts_with("id.");
        if (is_id)
            exr.channels.push_back({shape.channels[c], image::ExrType::kUint, {}, ids.view()});
        else
            exr.channels.push_back({shape.channels[c], shape.type, pixels[c].view(), {}});
    }
    image::write_exr(name, exr, 1);
}

Change set(std::size_t channel, int x, int y, float to) {
    return [=](Pixels& pixels) { pixels[channel].at(x, y) = to; };
}

// Two parts of one channel each.
void write_parts(const std::string& name, const std::string& second, float last) {
    std::vector<Imf::Header> headers;
    for (const std::string& part : {std::string("left"), second}) {
        Imf::Header header(8, 8);
        header.setName(part);
        header.setType(Imf::SCANLINEIMAGE);
        header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
        headers.push_back(header);
    }
    Imf::MultiPartOutputFile file(name.c_str(), headers.data(), 2);
    std::vector<float> pixels(64, 0.5f);
    for (int part = 0; part < 2; ++part) {
        if (part == 1) pixels.back() = last;
        Imf::OutputPart output(file, part);
        Imf::FrameBuffer buffer;
        buffer.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()), 4, 32));
        output.setFrameBuffer(buffer);
        output.writePixels(8);
    }
}

// 16384 x 16384 from one row that repeats, and another row at `odd_row`.
void write_huge(const std::string& name, int odd_row) {
    constexpr int kSide = 16384;
    Imf::Header header(kSide, kSide);
    header.compression() = Imf::RLE_COMPRESSION;
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    Imf::OutputFile file(name.c_str(), header);
    std::vector<half> row(kSide, half(0.25f)), odd(kSide, half(0.25f));
    odd[12345] = half(0.5f);
    const auto write_rows = [&](std::vector<half>& from, int count) {
        Imf::FrameBuffer buffer;
        buffer.insert("Y", Imf::Slice(Imf::HALF, reinterpret_cast<char*>(from.data()), 2, 0));
        file.setFrameBuffer(buffer);
        file.writePixels(count);
    };
    write_rows(row, odd_row);
    write_rows(odd, 1);
    write_rows(row, kSide - odd_row - 1);
}

void write_png(const std::string& name, int channels, int odd) {
    image::Picture picture{40, 30, channels, {}};
    for (int i = 0; i < 40 * 30 * channels; ++i)
        picture.bytes.push_back(static_cast<std::uint8_t>(i * 7 % 200));
    if (odd >= 0) picture.bytes[static_cast<std::size_t>(odd)] += 1;
    image::write_png(name, picture);
}

void write_values() {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    write("ref.exr", {});
    write("same.exr", {});
    write("other_codec.exr", {.compression = image::ExrCompression::kPiz});
    write("nan.exr", {}, set(0, 69, 65, nan));
    write("inf.exr", {}, set(2, 0, 0, infinity));
    write("alpha_nan.exr", {}, set(3, 5, 5, nan));
    write("one_pixel.exr", {}, set(1, 64, 64, 0.75f));
    write("one_ulp.exr", {}, set(1, 1, 1, std::nextafter(value(1, 1, 1), 2.0f)));
    write("alpha.exr", {}, set(3, 3, 3, 0.99f));
    write("zero.exr", {}, set(0, 3, 3, 0.0f));
    write("negative_zero.exr", {}, set(0, 3, 3, -0.0f));
    write("denormal.exr", {}, set(0, 3, 3, 1e-40f));
    write("huge_values.exr", {}, set(0, 3, 3, 3e38f));
    write("half.exr", {.type = image::ExrType::kHalf});
    write("uint.exr", {.type = image::ExrType::kUint});
}

void write_shapes() {
    write("wider.exr", {.width = 71});
    write("moved.exr", {.x0 = 1, .y0 = 2});
    write("crop.exr", {.width = 30, .height = 20, .display = {0, 0, 70, 66}, .x0 = 10, .y0 = 10});
    write("crop_moved.exr",
          {.width = 30, .height = 20, .display = {0, 0, 70, 66}, .x0 = 11, .y0 = 10});
    write("crop_pixel.exr",
          {.width = 30, .height = 20, .display = {0, 0, 70, 66}, .x0 = 10, .y0 = 10},
          set(0, 29, 19, 0.9f));
    write("renamed.exr", {.channels = {"R", "G", "C", "A"}});
    write("no_alpha.exr", {.channels = {"R", "G", "B"}});
    const std::vector<std::string> layered = {"R", "G", "B", "Z", "id.object"};
    write("layers.exr", {.channels = layered});
    write("layers_z.exr", {.channels = layered}, set(3, 8, 8, 99));
    write("layers_id.exr", {.channels = layered}, set(0, 8, 8, 0.9f));
    write("layers_extra.exr", {.channels = {"R", "G", "B", "Z", "id.object", "noise.X"}});
    write("single.exr", {.width = 1, .height = 1, .channels = {"Y"}});
    write("single_other.exr", {.width = 1, .height = 1, .channels = {"Y"}}, set(0, 0, 0, 1));
    write_parts("parts.exr", "right", 0.5f);
    write_parts("parts_pixel.exr", "right", 0.75f);
    write_parts("parts_renamed.exr", "other", 0.5f);
}

// White but for the pixels around (64, 64) and the last one.
void write_mask(const std::string& name) {
    image::Picture picture{70, 66, 3, {}};
    for (int y = 0; y < 66; ++y)
        for (int x = 0; x < 70; ++x)
            picture.bytes.insert(picture.bytes.end(), 3, x > 60 && y > 60 ? 0 : 255);
    image::write_png(name, picture);
}

void write_formats() {
    write_tiled("tiles.exr", false, 0, 0);
    write_tiled("tiles_pixel.exr", false, 0.5f, 0);
    write_tiled("mipmap.exr", true, 0, 0.25f);
    write_tiled("mipmap_level.exr", true, 0, 0.75f);
    write_tiled("mipmap_pixel.exr", true, 0.5f, 0.25f);
    write("scanlines.exr", {.channels = {"R", "G", "B"}});
    write_deep("deep.exr");
    write_windows("windows.exr", 0.5f);
    write_windows("windows_pixel.exr", 0.75f);
    write_jpeg("picture.jpg", 90, 0);
    write_jpeg("same.jpg", 90, 0);
    write_jpeg("other_quality.jpg", 50, 0);
    write_jpeg("pixel.jpg", 90, 60);
    write_radiance("picture.hdr", 70, 0);
    write_radiance("same.hdr", 70, 0);
    write_radiance("pixel.hdr", 70, 0.25f);
    write_radiance("narrow.hdr", 7, 0);
    write_radiance("narrow_pixel.hdr", 7, 0.25f);
}

}  // namespace

int main() {
    write_formats();
    write_mask("mask.png");
    write_values();
    write_shapes();
    write_huge("16k.exr", 0);
    write_huge("16k_same.exr", 0);
    write_huge("16k_pixel.exr", 9999);
    write_png("rgb.png", 3, -1);
    write_png("rgb_pixel.png", 3, 1000);
    write_png("rgba.png", 4, -1);
}
