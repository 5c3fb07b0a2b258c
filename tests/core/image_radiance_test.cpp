#include "core/image/radiance.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "core/error.h"

using namespace penumbra;
using namespace penumbra::image;

namespace {

constexpr int kWidth = 1200, kHeight = 700;

// Mantissas that are no marker of a run; the exponent is 130.
std::uint8_t mantissa(int x, int y, int channel) {
    return static_cast<std::uint8_t>(128 + (x * 7 + y * 13 + channel * 31) % 100);
}

// Rows by turns: flat; run-length coded by component; in the old code, each pixel behind as many
// empty runs as there may be, which makes them the longest rows of all.
std::vector<std::uint8_t> file_of_all_codes() {
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 700 +X 1200\n";
    std::vector<std::uint8_t> file(header.begin(), header.end());
    for (int y = 0; y < kHeight; ++y) {
        if (y % 3 == 1) {
            file.insert(file.end(), {2, 2, kWidth >> 8, kWidth & 255});
            for (int channel = 0; channel < 4; ++channel)
                for (int x = 0; x < kWidth; x += 100) {
                    file.push_back(channel == 3 ? 228 : 100);
                    if (channel == 3) file.push_back(130);
                    for (int i = 0; channel < 3 && i < 100; ++i)
                        file.push_back(mantissa(x + i, y, channel));
                }
            continue;
        }
        for (int x = 0; x < kWidth; ++x) {
            file.insert(file.end(), {mantissa(x, y, 0), mantissa(x, y, 1), mantissa(x, y, 2), 130});
            if (y % 3 == 2 && x + 1 < kWidth)
                file.insert(file.end(), {1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0});
        }
    }
    return file;
}

}  // namespace

TEST_CASE("rows of a Radiance file can be read in any order, whatever their codes") {
    const std::vector<std::uint8_t> content = file_of_all_codes();
    REQUIRE(content.size() > std::size_t{5} << 20);  // several pieces of the search for rows
    const FileReader file(content, "rows.hdr");
    const RadianceRows rows(file);
    REQUIRE(rows.width() == kWidth);
    REQUIRE(rows.height() == kHeight);
    int wrong = 0, seen = 0;
    const auto take = [&](int y, std::span<const float> rgb) {
        ++seen;
        for (int x = 0; x < kWidth; ++x)
            for (int channel = 0; channel < 3; ++channel)
                wrong += rgb[static_cast<std::size_t>(3 * x + channel)] !=
                         std::ldexp(static_cast<float>(mantissa(x, y, channel)), 130 - 136);
    };
    for (const int first : {690, 0, 333, 334, 101}) rows.read(first, first + 10, take);
    CHECK(seen == 50);
    CHECK(wrong == 0);
}

TEST_CASE("rows of a Radiance file are those of the picture decoded as a whole") {
    const std::vector<std::uint8_t> content = file_of_all_codes();
    const DecodedImage whole = decode_radiance(content, "rows.hdr");
    const FileReader file(content, "rows.hdr");
    std::vector<float> floats;
    RadianceRows(file).read(0, kHeight, [&](int, std::span<const float> rgb) {
        floats.insert(floats.end(), rgb.begin(), rgb.end());
    });
    CHECK(floats == whole.floats);
}

TEST_CASE("a long Radiance file that lacks a byte is refused when it is opened") {
    std::vector<std::uint8_t> content = file_of_all_codes();
    content.pop_back();
    const FileReader file(content, "cut.hdr");
    CHECK_THROWS_WITH_AS(RadianceRows{file}, doctest::Contains("cut off"), InputError);
}
