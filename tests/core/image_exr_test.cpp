#include "core/image/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "core/image/file_reader.h"
#include "tests/core/image_testing.h"

using namespace penumbra;
using namespace penumbra::image;

namespace {

constexpr ExrCompression kLossless[] = {ExrCompression::kNone, ExrCompression::kRle,
                                        ExrCompression::kZips, ExrCompression::kZip,
                                        ExrCompression::kPiz};

// Values that a half holds exactly, smooth with some noise.
Plane<float> half_exact_plane(int width, int height, std::uint64_t seed) {
    Random random(seed);
    Plane<float> plane(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            plane.at(x, y) =
                static_cast<float>(static_cast<int>(random.below(2048)) - 1024 + x) / 64;
        }
    }
    return plane;
}

Plane<std::uint32_t> id_plane(int width, int height) {
    Plane<std::uint32_t> plane(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            plane.at(x, y) = x % 3 == 0 ? 0xFFFFFFFFu : static_cast<std::uint32_t>(y * 40503 + x);
        }
    }
    return plane;
}

struct Sample {
    Plane<float> half, real;
    Plane<std::uint32_t> ids;
    ExrImage image;

    Sample(Window display, Window data, ExrCompression compression)
        : half(half_exact_plane(data.width(), data.height(), 1)),
          real(half_exact_plane(data.width(), data.height(), 2)),
          ids(id_plane(data.width(), data.height())) {
        real.at(0, 0) = 1.0f / 3.0f;
        image.display = display;
        image.data = data;
        image.compression = compression;
        image.channels = {{"R", ExrType::kHalf, half.view(), {}},
                          {"Z", ExrType::kFloat, real.view(), {}},
                          {"id.instance", ExrType::kUint, {}, ids.view()}};
    }
};

void check_same(const Plane<float>& a, const Plane<float>& b, int width, int height) {
    int different = 0;
    for (int y = 0; y < height; ++y) {
        different += std::memcmp(a.row(y), b.row(y), sizeof(float) * width) != 0;
    }
    CHECK(different == 0);
}

void check_round_trip(const Sample& sample, const std::filesystem::path& file) {
    const ExrPixels read = read_exr(file);
    CHECK(read.header.data == sample.image.data);
    CHECK(read.header.display == sample.image.display);
    CHECK(read.header.is_complete());
    CHECK(read.header.compression == name(sample.image.compression));
    const int width = sample.image.data.width();
    const int height = sample.image.data.height();
    check_same(read.find("R")->floats, sample.half, width, height);
    check_same(read.find("Z")->floats, sample.real, width, height);
    int different = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            different += read.find("id.instance")->ids.at(x, y) != sample.ids.at(x, y);
        }
    }
    CHECK(different == 0);
    CHECK(read.find("nothing") == nullptr);
}

}  // namespace

TEST_CASE("an EXR file gives back every channel type, with every lossless compression") {
    const TemporaryFolder folder;
    for (const ExrCompression compression : kLossless) {
        const Sample sample({0, 0, 83, 70}, {0, 0, 83, 70}, compression);
        write_exr(folder / "a.exr", sample.image, 2);
        check_round_trip(sample, folder / "a.exr");
    }
}

TEST_CASE("an EXR file gives back crops and windows off the origin") {
    const TemporaryFolder folder;
    const Window windows[] = {{0, 0, 1, 1}, {17, 5, 50, 300}, {-20, -7, 13, 1}, {99, 99, 100, 100}};
    for (const Window& data : windows) {
        const Sample sample({0, 0, 100, 100}, data, ExrCompression::kZip);
        write_exr(folder / "a.exr", sample.image, 1);
        check_round_trip(sample, folder / "a.exr");
    }
}

TEST_CASE("a crop written from inside a larger plane is that part of it") {
    const TemporaryFolder folder;
    const Plane<float> full = half_exact_plane(130, 90, 3);
    ExrImage image;
    image.display = {0, 0, 130, 90};
    image.data = {101, 33, 130, 90};
    image.channels = {{"Y", ExrType::kHalf, full.view().offset(101, 33), {}},
                      {"Z", ExrType::kFloat, full.view().offset(101, 33), {}}};
    write_exr(folder / "a.exr", image, 1);
    const ExrPixels read = read_exr(folder / "a.exr");
    for (const ExrPlane& plane : read.planes) {
        int different = 0;
        for (int y = 0; y < 57; ++y) {
            for (int x = 0; x < 29; ++x) {
                different += plane.floats.at(x, y) != full.at(x + 101, y + 33);
            }
        }
        CHECK(different == 0);
    }
}

TEST_CASE("an EXR file has the same bytes whatever the number of threads") {
    const TemporaryFolder folder;
    for (const ExrCompression compression :
         {ExrCompression::kZip, ExrCompression::kPiz, ExrCompression::kDwaa}) {
        const Sample sample({0, 0, 200, 700}, {3, 2, 190, 699}, compression);
        write_exr(folder / "one.exr", sample.image, 1);
        for (const int threads : {2, 3, 7}) {
            write_exr(folder / "many.exr", sample.image, threads);
            CHECK(read_whole_file(folder / "one.exr") == read_whole_file(folder / "many.exr"));
        }
    }
}

TEST_CASE("an EXR file keeps its metadata") {
    const TemporaryFolder folder;
    Sample sample({0, 0, 4, 4}, {0, 0, 4, 4}, ExrCompression::kZip);
    ExrMatrix matrix;
    for (int i = 0; i < 16; ++i) matrix.values[i] = 0.25f * static_cast<float>(i);
    sample.image.metadata = {{"software", std::string("penumbra 0.1.0")},
                             {"frame", 48},
                             {"exposure", -1.5f},
                             {"worldToCamera", matrix},
                             {"framesPerSecond", ExrRational{24000, 1001}}};
    write_exr(folder / "a.exr", sample.image, 1);
    CHECK(read_exr_header(folder / "a.exr").metadata == sample.image.metadata);
}

TEST_CASE("half channels count what they clamp and do not hide NaN") {
    const TemporaryFolder folder;
    Plane<float> plane(19, 3);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const float row[] = {65504, 65504.1f, 65520, -1e30f, 3e38f, kInfinity, -kInfinity, kNan, 1};
    for (int x = 0; x < 9; ++x) plane.at(x + 10, 2) = row[x];
    ExrImage image;
    image.display = image.data = {0, 0, 19, 3};
    image.channels = {{"R", ExrType::kHalf, plane.view(), {}},
                      {"Z", ExrType::kFloat, plane.view(), {}}};
    const ExrWriteReport report = write_exr(folder / "a.exr", image, 1);
    CHECK(report.clamped_values == 4);
    CHECK(report.non_finite_values == 6);
    const ExrPixels read = read_exr(folder / "a.exr");
    const float* stored = read.find("R")->floats.row(2) + 10;
    const float expected[] = {65504, 65504, 65504, -65504, 65504, kInfinity, -kInfinity};
    for (int x = 0; x < 7; ++x) CHECK(stored[x] == expected[x]);
    CHECK(std::isnan(stored[7]));
    CHECK(stored[8] == 1);
}

TEST_CASE("an EXR file cut off anywhere is found out, and never read") {
    const TemporaryFolder folder;
    for (const ExrCompression compression : {ExrCompression::kZips, ExrCompression::kNone}) {
        const Sample sample({0, 0, 12, 9}, {0, 0, 12, 9}, compression);
        write_exr(folder / "whole.exr", sample.image, 1);
        const std::vector<std::uint8_t> whole = read_whole_file(folder / "whole.exr");
        int undetected = 0;
        for (std::size_t length = 0; length < whole.size(); ++length) {
            write_bytes(folder / "cut.exr", std::span(whole).first(length));
            try {
                undetected += read_exr_header(folder / "cut.exr").is_complete();
            } catch (const InputError&) {
            }
            CHECK_THROWS_AS((void)read_exr(folder / "cut.exr"), InputError);
        }
        CHECK(undetected == 0);
    }
}

TEST_CASE("mutated EXR files give an error or an image, and nothing worse") {
    const TemporaryFolder folder;
    for (const ExrCompression compression :
         {ExrCompression::kNone, ExrCompression::kRle, ExrCompression::kZip, ExrCompression::kPiz,
          ExrCompression::kDwaa}) {
        Sample sample({0, 0, 40, 35}, {0, 0, 40, 35}, compression);
        sample.image.metadata = {{"software", std::string("penumbra")}, {"m", ExrMatrix{}}};
        write_exr(folder / "whole.exr", sample.image, 1);
        const std::vector<std::uint8_t> whole = read_whole_file(folder / "whole.exr");
        for (int i = 0; i < 150; ++i) {
            write_bytes(folder / "mutant.exr", mutate(whole, static_cast<std::uint64_t>(i)));
            try {
                (void)read_exr(folder / "mutant.exr");
            } catch (const InputError&) {
            }
        }
    }
}

TEST_CASE("DWAA, lossy, stays close in colours and exact in ids and depth") {
    const TemporaryFolder folder;
    Sample sample({0, 0, 64, 64}, {0, 0, 64, 64}, ExrCompression::kDwaa);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) sample.half.at(x, y) = 1 + 0.01f * static_cast<float>(x + y);
    }
    write_exr(folder / "a.exr", sample.image, 2);
    const ExrPixels read = read_exr(folder / "a.exr");
    float worst = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            worst =
                std::max(worst, std::fabs(read.find("R")->floats.at(x, y) - sample.half.at(x, y)));
        }
    }
    CHECK(worst < 0.03f);
    CHECK(read.find("id.instance")->ids.at(5, 7) == sample.ids.at(5, 7));
    check_same(read.find("Z")->floats, sample.real, 64, 64);
}

TEST_CASE("a tiled EXR file with mip levels gives its full-size level") {
    const TemporaryFolder folder;
    const Plane<float> plane = half_exact_plane(50, 41, 6);
    {
        Imf::Header header(50, 41);
        header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
        header.setTileDescription({16, 8, Imf::MIPMAP_LEVELS});
        Imf::TiledOutputFile file((folder / "tiled.exr").c_str(), header, 0);
        Imf::FrameBuffer buffer;
        buffer.insert(
            "Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(plane.row(0))),
                            sizeof(float), plane.stride() * sizeof(float)));
        file.setFrameBuffer(buffer);
        for (int level = 0; level < file.numLevels(); ++level) {
            file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
        }
    }
    const ExrPixels read = read_exr(folder / "tiled.exr");
    CHECK(read.header.is_tiled);
    CHECK(read.header.is_complete());
    check_same(read.find("Y")->floats, plane, 50, 41);
}

TEST_CASE("a subsampled channel is refused by name, an unfinished file as incomplete") {
    const TemporaryFolder folder;
    const std::string path = (folder / "a.exr").string();
    Imf::Header header(8, 8);
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    header.channels().insert("RY", Imf::Channel(Imf::HALF, 2, 2));
    // Never given pixels: what a killed writer leaves.
    { const Imf::OutputFile file(path.c_str(), header, 0); }
    const ExrHeader read = read_exr_header(path);
    CHECK(read.missing_chunks == read.chunks);
    CHECK_THROWS_WITH_AS((void)read_exr(path), doctest::Contains("incomplete"), InputError);
    {
        Imf::OutputFile file(path.c_str(), header, 0);
        std::vector<std::uint16_t> zeros(64, 0);
        Imf::FrameBuffer buffer;
        char* pixels = reinterpret_cast<char*>(zeros.data());
        buffer.insert("Y", Imf::Slice(Imf::HALF, pixels, 2, 16));
        buffer.insert("RY", Imf::Slice(Imf::HALF, pixels, 2, 8, 2, 2));
        file.setFrameBuffer(buffer);
        file.writePixels(8);
    }
    CHECK_THROWS_WITH_AS((void)read_exr(path), doctest::Contains("'RY' is subsampled 2 x 2"),
                         InputError);
}

TEST_CASE("writing an EXR file to a full disk is an error") {
    const Sample sample({0, 0, 83, 70}, {0, 0, 83, 70}, ExrCompression::kZip);
    CHECK_THROWS_AS(write_exr("/dev/full", sample.image, 1), OutputError);
    CHECK_THROWS_AS(write_exr("/dev/full", sample.image, 3), OutputError);
    CHECK_THROWS_AS(write_exr("/nowhere/a.exr", sample.image, 1), OutputError);
}

TEST_CASE("a file that is no EXR, a folder and a missing file are input errors that say so") {
    const TemporaryFolder folder;
    write_bytes(folder / "a.exr", std::vector<std::uint8_t>(100, 'x'));
    CHECK_THROWS_WITH_AS((void)read_exr_header(folder / "a.exr"),
                         doctest::Contains("is not an EXR file"), InputError);
    CHECK_THROWS_WITH_AS((void)read_exr_header(folder / ""), doctest::Contains("is a folder"),
                         InputError);
    CHECK_THROWS_WITH_AS((void)read_exr_header(folder / "b.exr"), doctest::Contains("No such file"),
                         InputError);
}
