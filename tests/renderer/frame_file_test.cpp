#include "apps/renderer/frame_file.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <unistd.h>
#include <cmath>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "apps/renderer/builtin_scene.h"
#include "core/frame/visibility.h"
#include "core/image/exr.h"
#include "tests/renderer/support.h"

using namespace penumbra;
using namespace penumbra::tests;

namespace {

struct TemporaryFile {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() /
        ("penumbra_frame_file_test_" + std::to_string(::getpid()) + ".exr");
    ~TemporaryFile() { std::filesystem::remove(path); }
};

struct Rendered {
    Film film;
    renderer::FrameIdentity identity;
};

Rendered rendered(const ImageSettings& settings,
                  const Scene& scene = renderer::read_builtin_scene()) {
    renderer::Renderer renderer(scene, settings, {});
    Rendered result;
    renderer.render(5, all_aovs(), result.film);
    result.identity = {.frame = 5, .camera = renderer.camera(), .digest = "d", .settings = "s"};
    return result;
}

// Nothing is hit in the corners of its picture.
Scene box() {
    return read_scene(data_scene("cornell-box/cornell-box.json"));
}

image::ExrPixels written(const Rendered& r, const renderer::OutputSettings& output) {
    const TemporaryFile file;
    renderer::OutputSettings to_file = output;
    to_file.pattern = file.path.string();
    renderer::write_frame(r.film, r.identity, to_file, 2);
    return image::read_exr(file.path);
}

}  // namespace

TEST_CASE("a frame's file has the channels, types and windows of the AOV table") {
    const Rendered r = rendered({.width = 100, .height = 60, .crop = PixelRect{10, 20, 75, 50}});
    const image::ExrPixels file = written(r, {.aovs = all_aovs()});
    CHECK(file.header.display == image::Window{0, 0, 100, 60});
    CHECK(file.header.data == image::Window{10, 20, 75, 50});
    std::size_t channels = 0;
    for (const renderer::AovInfo& aov : renderer::aov_table()) {
        for (const renderer::AovChannel& channel : aov.channels()) {
            const std::string_view name = channel.name;
            CAPTURE(std::string(name));
            const image::ExrPlane* plane = file.find(name);
            REQUIRE(plane != nullptr);
            const auto expected = aov.type == renderer::SampleType::kHalf ? image::ExrType::kHalf
                                  : aov.type == renderer::SampleType::kFloat
                                      ? image::ExrType::kFloat
                                      : image::ExrType::kUint;
            CHECK(plane->type == expected);
            ++channels;
        }
    }
    CHECK(file.planes.size() == channels);
}

TEST_CASE("where nothing is hit every AOV has the value of its row") {
    const Rendered r = rendered({.width = 100, .height = 60}, box());
    const image::ExrPixels file = written(r, {.aovs = all_aovs(), .float_precision = true});
    const auto is_empty = [&](int x, int y) {
        return file.find("id.triangle")->ids.at(x, y) == kNothing &&
               file.find("Z")->floats.at(x, y) == kDepthOfNothing;
    };
    for (const renderer::AovInfo& aov : renderer::aov_table()) {
        if (!aov.nothing) continue;
        for (const renderer::AovChannel& channel : aov.channels()) {
            CAPTURE(std::string(channel.name));
            const image::ExrPlane& plane = *file.find(channel.name);
            int empty = 0;
            int wrong = 0;
            for (int y = 0; y < 60; ++y)
                for (int x = 0; x < 100; ++x) {
                    if (!is_empty(x, y)) continue;
                    ++empty;
                    wrong += *aov.nothing != (aov.type == renderer::SampleType::kUint
                                                  ? static_cast<double>(plane.ids.at(x, y))
                                                  : static_cast<double>(plane.floats.at(x, y)));
                }
            CHECK(empty > 100);
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("facing is the cosine between the shading normal and the direction to the eye") {
    const Rendered r = rendered({.width = 100, .height = 60});
    int hits = 0;
    double worst = 0;
    float lowest = 1;
    float highest = 0;
    each_pixel(r.film, [&](int x, int y) {
        const auto vector = [&](Aov aov) {
            const auto at = [&](std::size_t i) {
                return static_cast<double>(r.film.numbers(aov, i).at(x, y));
            };
            return Vec3d{at(0), at(1), at(2)};
        };
        if (r.film.depth.at(x, y) == kDepthOfNothing) return;
        const Vec3f& eye = r.identity.camera.eye;
        const Vec3d to_eye = Vec3d{eye.x, eye.y, eye.z} - vector(Aov::kP);
        const double cosine = dot(vector(Aov::kN), to_eye) / std::sqrt(dot(to_eye, to_eye));
        const float found = r.film.numbers(Aov::kFacing, 0).at(x, y);
        worst = std::max(worst, std::abs(std::clamp(cosine, 0.0, 1.0) - found));
        lowest = std::min(lowest, found);
        highest = std::max(highest, found);
        ++hits;
    });
    CHECK(hits > 1000);
    CHECK(worst < 1e-6);
    CHECK(lowest < 0.2f);
    CHECK(highest > 0.9f);
}

TEST_CASE("over several passes edges of means are smooth, those of first passes sharp") {
    const Film film = render(box(), {.width = 100, .height = 60, .passes = 4});
    const auto count = [&](Aov aov, std::size_t channel, float low, float high) {
        int values = 0;
        each_pixel(film, [&](int x, int y) {
            const float value = film.numbers(aov, channel).at(x, y);
            values += value > low && value < high;
        });
        return values;
    };
    float highest = 0;
    each_pixel(film, [&](int x, int y) {
        highest = std::max(highest, film.numbers(Aov::kRoughness, 0).at(x, y));
    });
    CHECK(count(Aov::kBeauty, 3, 0.01f, 0.99f) > 10);  // coverage
    CHECK(count(Aov::kRoughness, 0, 0.01f * highest, 0.3f * highest) > 10);
    CHECK(count(Aov::kZ, 0, 1e6f, 0.99e10f) == 0);
    CHECK(highest <= 1);
}

TEST_CASE("every AOV stands in the README with its name, and is offered by --aov") {
    std::ifstream file(std::filesystem::path(PENUMBRA_SOURCE_DIR) / "README.md");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const std::size_t begin = text.find("### What a frame holds");
    const std::string table = text.substr(begin, text.find("###", begin + 3) - begin);
    for (const renderer::AovInfo& aov : renderer::aov_table()) {
        CAPTURE(std::string(aov.name));
        CHECK(table.find(fmt::format("`{}`", aov.name)) != std::string::npos);
        CHECK(renderer::parse_aov_list(aov.name) == AovSet{aov.aov});
    }
}

TEST_CASE("the pixels of the file are the film's, at their place") {
    const Rendered r = rendered({.width = 100, .height = 60, .crop = PixelRect{10, 20, 75, 50}});
    const image::ExrPixels file = written(r, {.aovs = all_aovs(), .float_precision = true});
    const image::ExrPlane& depth = *file.find("Z");
    const image::ExrPlane& red = *file.find("R");
    const image::ExrPlane& triangle = *file.find("id.triangle");
    int wrong = 0;
    for (int y = 0; y < 30; ++y) {
        for (int x = 0; x < 65; ++x) {
            const int fx = x + 10 - r.film.window.x0;
            const int fy = y + 20 - r.film.window.y0;
            wrong += depth.floats.at(x, y) != r.film.depth.at(fx, fy);
            wrong += red.floats.at(x, y) != r.film.beauty[0].at(fx, fy);
            wrong += triangle.ids.at(x, y) != r.film.ids(Aov::kId, 1).at(fx, fy);
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE(
    "worldToNDC takes the world position of a pixel to its place, and worldToCamera to its depth") {
    const Rendered r = rendered({.width = 120, .height = 80});
    const image::ExrPixels file = written(r, {.aovs = {Aov::kP, Aov::kZ, Aov::kId}});
    const auto matrix = [&](const char* name) {
        return std::get<image::ExrMatrix>(file.header.metadata.at(name)).values;
    };
    const auto row_times = [](const std::array<float, 16>& m, const Vec3f& p, int column) {
        const auto c = static_cast<std::size_t>(column);
        return p.x * m[c] + p.y * m[4 + c] + p.z * m[8 + c] + m[12 + c];
    };
    const std::array<float, 16> ndc = matrix("worldToNDC");
    const std::array<float, 16> camera = matrix("worldToCamera");
    int pixels = 0;
    int off_centre = 0;
    float worst_pixel = 0;
    int off_depth = 0;
    for (int y = 0; y < 80; ++y) {
        for (int x = 0; x < 120; ++x) {
            if (file.find("id.triangle")->ids.at(x, y) == kNothing) continue;
            const Vec3f p{file.find("P.X")->floats.at(x, y), file.find("P.Y")->floats.at(x, y),
                          file.find("P.Z")->floats.at(x, y)};
            const float w = row_times(ndc, p, 3);
            const float dx = row_times(ndc, p, 0) / w * 120 - (static_cast<float>(x) + 0.5f);
            const float dy = row_times(ndc, p, 1) / w * 80 - (static_cast<float>(y) + 0.5f);
            ++pixels;
            off_centre += std::hypot(dx, dy) > 0.01f;
            worst_pixel = std::max(worst_pixel, std::hypot(dx, dy));
            const float z = file.find("Z")->floats.at(x, y);
            off_depth += std::abs(row_times(camera, p, 2) / z - 1) > 1e-5f;
        }
    }
    // Positions are clamped to their triangle, which coverage on the snapped grid may miss by 1/256
    // pixel: little in itself, but seen edge-on that is far along the triangle.
    CHECK(off_centre < pixels / 500);
    CHECK(worst_pixel < 0.25f);
    CHECK(off_depth < pixels / 500);
}

TEST_CASE("the same frame gives the same bytes") {
    const Rendered r = rendered({.width = 64, .height = 64});
    const image::ExrHeader header = written(r, {.aovs = all_aovs()}).header;
    for (const char* name : {"software", "frame", "framesPerSecond", "worldToCamera", "worldToNDC",
                             "penumbraDigest", "penumbraSettings"})
        CHECK(header.metadata.count(name) == 1);
    for (const char* name : {"capDate", "utcOffset", "owner", "comments"})
        CHECK(header.metadata.count(name) == 0);
}
