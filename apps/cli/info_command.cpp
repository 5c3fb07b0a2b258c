#include "apps/cli/info_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "apps/cli/option_checks.h"
#include "apps/cli/say.h"
#include "core/error.h"
#include "core/image/exr.h"
#include "core/scene/read_scene.h"

namespace penumbra::cli {
namespace {

void print_row(std::string_view key, const std::string& value) {
    say(stdout, "{:<12} {}\n", key, value);
}

std::string to_text(const image::Window& w) {
    return fmt::format("{} x {} at ({}, {})", w.width(), w.height(), w.x0, w.y0);
}

std::string to_text(const image::ExrValue& value) {
    struct Print {
        std::string operator()(const std::string& s) const { return s; }
        std::string operator()(int i) const { return fmt::format("{}", i); }
        std::string operator()(float f) const { return fmt::format("{}", f); }
        std::string operator()(const image::ExrMatrix& m) const {
            std::string text;
            for (std::size_t i = 0; i < 16; ++i)
                text += fmt::format("{}{}", i == 0 ? "" : " ", m.values[i]);
            return text;
        }
        std::string operator()(const image::ExrRational& r) const {
            return fmt::format("{}/{}", r.numerator, r.denominator);
        }
    };
    return std::visit(Print{}, value);
}

void print_exr(const std::string& path) {
    const image::ExrHeader header = image::read_exr_header(path);
    print_row("file", path);
    print_row("state", header.is_complete() ? "complete"
                                            : fmt::format("incomplete: {} of {} blocks are missing",
                                                          header.missing_chunks, header.chunks));
    print_row("display", to_text(header.display));
    print_row("data", to_text(header.data));
    print_row("layout",
              fmt::format("{}, {}{}, {} part{}", header.compression,
                          header.is_tiled ? "tiles" : "scan lines", header.is_deep ? ", deep" : "",
                          header.parts, header.parts == 1 ? "" : "s"));
    for (const image::ExrChannelInfo& channel : header.channels)
        print_row("channel", fmt::format("{} {}", channel.name, image::name(channel.type)));
    for (const auto& [key, value] : header.metadata)
        say(stdout, "{:<12} {}\n", key, to_text(value));
}

void print_scene(const std::string& path) {
    const Scene scene = read_scene(path);
    std::size_t triangles = 0;
    std::size_t dropped = 0;
    for (const Mesh& mesh : scene.meshes) dropped += mesh.dropped_triangles;
    for (const Model& model : scene.models) triangles += scene.meshes[model.mesh].triangles.size();
    print_row("scene", path);
    print_row("film", fmt::format("{} x {}", scene.width, scene.height));
    print_row("frames", fmt::format("{} to {} at {} per second", scene.animation.first_frame,
                                    scene.animation.last_frame, scene.animation.frames_per_second));
    for (const Model& model : scene.models) {
        const Mesh& mesh = scene.meshes[model.mesh];
        print_row("model",
                  fmt::format("{}: {} triangles, {} vertices{}", model.name, mesh.triangles.size(),
                              mesh.positions.size(), model.transform.moves() ? ", moves" : ""));
    }
    print_row("triangles", fmt::format("{} ({} degenerate ones dropped)", triangles, dropped));
    print_row("materials", fmt::format("{}", scene.materials.size()));
    for (const Texture& texture : scene.textures)
        print_row("texture", fmt::format("{}: {} x {}", texture.name, texture.levels[0].width,
                                         texture.levels[0].height));
    for (const Light& light : scene.lights)
        print_row("light", fmt::format("{}: {}{}", light.name, kind_name(light.shape),
                                       light.two_sided ? ", two-sided" : ""));
    print_row("emitters", fmt::format("{} (emissive faces of models)", scene.emitters.size()));
    for (const std::string& warning : scene.warnings) print_row("warning", warning);
}

// The first bytes of every EXR file.
bool is_exr(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    unsigned char magic[4] = {};
    file.read(reinterpret_cast<char*>(magic), sizeof magic);
    return file.gcount() == 4 && magic[0] == 0x76 && magic[1] == 0x2f && magic[2] == 0x31 &&
           magic[3] == 0x01;
}

}  // namespace

std::shared_ptr<std::string> add_info_command(CLI::App& app, int& exit_code) {
    auto path = std::make_shared<std::string>();
    CLI::App* command =
        app.add_subcommand("info", "Tell what a scene, a model or an EXR file holds");
    command->add_option("FILE", *path, "A scene (.json), a model (.obj) or an EXR file")
        ->type_name("FILE.json|obj|exr")
        ->required();
    command->footer(
        "Examples:\n"
        "  penumbra info shot.json        size, frames, models, materials, lights\n"
        "  penumbra info shot.0001.exr    windows, channels, metadata; whether it is complete");
    command->callback([path, command, &exit_code] {
        refuse_empty_values(*command);
        require_regular_file(*path);
        const std::string extension = std::filesystem::path(*path).extension().string();
        if (is_exr(*path) || extension == ".exr")
            print_exr(*path);
        else
            print_scene(*path);
        exit_code = 0;
    });
    return path;
}

}  // namespace penumbra::cli
