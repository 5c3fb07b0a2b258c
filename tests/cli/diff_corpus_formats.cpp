// Pictures in other formats than plain EXR: tiles, mip-maps, deep pixels, several parts, HDR, JPEG.

#include "tests/cli/diff_corpus_formats.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace {

constexpr int kWidth = 70, kHeight = 66;

Imf::Header header_of(int width, int height) {
    Imf::Header header(width, height);
    for (const char* name : {"R", "G", "B"})
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    return header;
}

float value(int x, int y, int channel) {
    return static_cast<float>((x * 7 + y * 5 + channel * 11) % 32) / 32.0f;
}

std::vector<float> rgb_pixels() {
    std::vector<float> pixels;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int channel = 0; channel < 3; ++channel) pixels.push_back(value(x, y, channel));
    return pixels;
}

Imf::FrameBuffer buffer_of(std::vector<float>& rgb, int width) {
    Imf::FrameBuffer buffer;
    const char* const names[] = {"R", "G", "B"};
    for (int i = 0; i < 3; ++i)
        buffer.insert(names[i], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&rgb[i]), 12,
                                           static_cast<std::size_t>(width) * 12));
    return buffer;
}

}  // namespace

void write_tiled(const std::string& name, bool has_levels, float odd, float odd_in_level) {
    Imf::Header header = header_of(kWidth, kHeight);
    header.setTileDescription(
        Imf::TileDescription(32, 16, has_levels ? Imf::MIPMAP_LEVELS : Imf::ONE_LEVEL));
    Imf::TiledOutputFile file(name.c_str(), header);
    for (int level = 0; level < file.numLevels(); ++level) {
        const int width = file.levelWidth(level), height = file.levelHeight(level);
        std::vector<float> pixels = rgb_pixels();
        if (level > 0) pixels.assign(static_cast<std::size_t>(width) * height * 3, odd_in_level);
        if (level == 0) pixels.back() += odd;
        file.setFrameBuffer(buffer_of(pixels, width));
        file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
    }
}

void write_deep(const std::string& name) {
    Imf::Header header(8, 8);
    header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
    header.setType(Imf::DEEPSCANLINE);
    header.compression() = Imf::ZIPS_COMPRESSION;
    Imf::DeepScanLineOutputFile file(name.c_str(), header);
    std::vector<unsigned> counts(64, 1);
    std::vector<float> depths(64, 2.0f);
    std::vector<float*> pointers;
    for (float& depth : depths) pointers.push_back(&depth);
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 32));
    buffer.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers.data()),
                                      sizeof(float*), 8 * sizeof(float*), sizeof(float)));
    file.setFrameBuffer(buffer);
    file.writePixels(8);
}

void write_windows(const std::string& name, float last) {
    std::vector<Imf::Header> headers;
    for (int part = 0; part < 2; ++part) {
        Imf::Header header(Imath::Box2i({0, 0}, {63, 31}),
                           Imath::Box2i({20 * part, 10 * part}, {20 * part + 15, 10 * part + 7}));
        header.setName(part == 0 ? "left" : "right");
        header.setType(Imf::SCANLINEIMAGE);
        header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
        headers.push_back(header);
    }
    Imf::MultiPartOutputFile file(name.c_str(), headers.data(), 2);
    for (int part = 0; part < 2; ++part) {
        std::vector<float> pixels(16 * 8, 0.5f);
        if (part == 1) pixels.back() = last;
        Imf::OutputPart output(file, part);
        Imf::FrameBuffer buffer;
        char* const origin =
            reinterpret_cast<char*>(pixels.data()) - 4 * (20 * part) - 64 * (10 * part);
        buffer.insert("Y", Imf::Slice(Imf::FLOAT, origin, 4, 64));
        output.setFrameBuffer(buffer);
        output.writePixels(8);
    }
}

void write_jpeg(const std::string& name, int quality, int odd) {
    std::vector<std::uint8_t> bytes;
    for (const float each : rgb_pixels()) bytes.push_back(static_cast<std::uint8_t>(each * 255));
    bytes[static_cast<std::size_t>(3 * (40 * kWidth + 30))] += static_cast<std::uint8_t>(odd);
    if (stbi_write_jpg(name.c_str(), kWidth, kHeight, 3, bytes.data(), quality) == 0)
        throw std::runtime_error(name + " cannot be written");
}

void write_radiance(const std::string& name, int width, float odd) {
    std::vector<float> pixels = rgb_pixels();
    pixels.resize(static_cast<std::size_t>(width) * kHeight * 3);
    pixels[static_cast<std::size_t>(3 * (width * 40 + 1))] += odd;
    if (stbi_write_hdr(name.c_str(), width, kHeight, 3, pixels.data()) == 0)
        throw std::runtime_error(name + " cannot be written");
}
