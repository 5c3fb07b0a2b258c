#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "apps/diff/html_parts.h"
#include "apps/diff/spool.h"
#include "apps/diff/tile_pictures.h"
#include "apps/page/html.h"

using namespace penumbra;
using namespace penumbra::diff;

namespace {

constexpr std::uint8_t kBright = 255;

// Pixels of an error map that are not black.
int lit_pixels(const image::Picture& map) {
    int count = 0;
    for (std::size_t i = 0; i < map.bytes.size(); i += 3) count += map.bytes[i] > 0;
    return count;
}

struct Folder {
    std::filesystem::path path;
    Folder()
        : path(std::filesystem::temp_directory_path() /
               ("penumbra_report_pieces." + std::to_string(::getpid()))) {
        std::filesystem::create_directories(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }
};

}  // namespace

TEST_CASE("an error map shows a pixel at its place among the windows of all parts") {
    HeatCanvas map({-10, -20, 54, 44});
    map.place({0, 0, 0, kBright}, {0, 0, 2, 2}, 30, 20);
    const image::Picture picture = map.picture();
    REQUIRE(picture.width == 64);
    REQUIRE(picture.height == 64);
    CHECK(lit_pixels(picture) == 1);
    CHECK(picture.bytes[static_cast<std::size_t>(3 * (41 * 64 + 41))] > 200);
}

TEST_CASE("tiles of several parts on each other leave the larger error") {
    HeatCanvas map({0, 0, 1, 1});
    map.place({200}, {0, 0, 1, 1}, 0, 0);
    const image::Picture larger = map.picture();
    map.place({100}, {0, 0, 1, 1}, 0, 0);
    CHECK(map.picture().bytes == larger.bytes);
}

TEST_CASE("a map of windows that lie far apart stays small and loses no error") {
    constexpr int kFar = 1 << 24;
    HeatCanvas map({-kFar, 0, kFar, 8});
    map.place({kBright}, {0, 0, 1, 1}, -kFar, 0);
    map.place({kBright}, {0, 0, 1, 1}, kFar - 1, 7);
    const image::Picture picture = map.picture();
    CHECK(picture.width <= 4096);
    CHECK(picture.height == 1);
    CHECK(lit_pixels(picture) == 2);
}

TEST_CASE("a spool gives back what was appended and leaves nothing behind") {
    const Folder folder;
    std::string expected;
    {
        Spool spool(folder.path / "page.html");
        for (int i = 0; i < 3000; ++i) {
            const std::string text(static_cast<std::size_t>(1000 + i % 7),
                                   static_cast<char>('a' + i % 26));
            spool.append(text);
            expected += text;
        }
        CHECK(std::filesystem::is_empty(folder.path));
        image::PendingFile page(folder.path / "page.html");
        spool.copy_to(page);
        page.publish();
    }
    std::ifstream file(folder.path / "page.html");
    std::stringstream content;
    content << file.rdbuf();
    CHECK(content.str() == expected);
}

TEST_CASE("names of files cannot become parts of a page") {
    CHECK(page::html_escaped("<img src=\"x\">&") == "&lt;img src=&quot;x&quot;&gt;&amp;");
    CHECK(html_begin("</title><script>").find("<script>") == std::string::npos);
}

TEST_CASE("a page forbids every request") {
    CHECK(html_begin("title").find("default-src 'none'") != std::string::npos);
    const std::string still = page::html_begin("title", page::Content::kStill, "");
    CHECK(still.find("default-src 'none'") != std::string::npos);
    CHECK(still.find("script-src") == std::string::npos);
}
