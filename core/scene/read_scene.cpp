#include "core/scene/read_scene.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/json/node.h"
#include "core/parallel/arena.h"
#include "core/scene/camera_check.h"
#include "core/scene/frame_model.h"
#include "core/scene/read_lights.h"
#include "core/scene/read_tracks.h"
#include "core/scene/scene_builder.h"
#include "core/text_scan.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

// Pixels are snapped to 1/256 in 24 bits, with room for what lies beside the film.
constexpr int kLargestFilmSide = 16384;
constexpr int kMostShadowRays = 64;
// Frames at which an animation is checked before anything is rendered.
constexpr int kCheckedFrames = 10000;

std::string lower_extension(const fs::path& file) {
    std::string text = file.extension().string();
    std::transform(text.begin(), text.end(), text.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return text;
}

void read_film(const json::Node& document, Scene& scene) {
    const auto film = document.find("film");
    if (!film) return;
    film->allow({"size"});
    const auto size = film->find("size");
    if (!size) return;
    if (size->size() != 2) size->expected("width and height");
    scene.width = (*size)[0].integer(1, kLargestFilmSide);
    scene.height = (*size)[1].integer(1, kLargestFilmSide);
}

void read_animation(const json::Node& document, Scene& scene) {
    const auto animation = document.find("animation");
    if (!animation) return;
    animation->allow({"fps", "frames"});
    if (const auto fps = animation->find("fps"))
        scene.animation.frames_per_second = fps->number({1e-3, 1e5});
    const auto frames = animation->find("frames");
    if (!frames) return;
    if (frames->size() != 2) frames->expected("the first and the last frame");
    scene.animation.first_frame = (*frames)[0].integer(-1000000, 1000000);
    scene.animation.last_frame = (*frames)[1].integer(scene.animation.first_frame, 1000000);
}

void read_render(const json::Node& document, Scene& scene) {
    const auto render = document.find("render");
    if (!render) return;
    render->allow({"spp"});
    if (const auto spp = render->find("spp"))
        scene.samples_per_pixel = spp->integer(1, kMostShadowRays);
}

void read_environment(const json::Node& document, Scene& scene) {
    const auto environment = document.find("environment");
    if (!environment) return;
    environment->allow({"radiance", "file", "scale", "rotate"});
    for (const char* field : {"file", "scale", "rotate"})
        if (environment->has(field))
            environment->fail(fmt::format(
                "\"{}\" is not supported yet; expected \"radiance\", a constant colour", field));
    scene.background = environment->require("radiance").vector(json::kNonNegative);
}

void read_camera(const json::Node& document, Scene& scene) {
    const auto node = document.find("camera");
    if (!node) {
        if (scene.models.empty()) document.fail("\"camera\" is missing, and there is no model");
        scene.camera = framing_camera(scene);
        return;
    }
    const KeyedNode keyed(*node, {"eye", "target", "up", "vfov"}, {"near"});
    constexpr json::Range kCameraPosition{-1e9, 1e9};
    scene.camera = {.eye = keyed.vectors("eye", kCameraPosition, std::nullopt),
                    .target = keyed.vectors("target", kCameraPosition, std::nullopt),
                    .up = keyed.vectors("up", kCameraPosition, Vec3f{0, 1, 0}),
                    .vertical_field_of_view = keyed.numbers("vfov", {0.01, 179}, 45.0f),
                    .near_distance = std::nullopt};
    if (const auto near = node->find("near"))
        scene.camera.near_distance = static_cast<float>(near->number({1e-9, 1e6}));
    if (keyed.keys().empty()) {
        if (const auto problem = camera_problem(scene.camera, 0)) node->fail(*problem);
    }
    for (const auto& key : keyed.keys())
        if (const auto problem = camera_problem(scene.camera, key.time))
            node->fail(fmt::format("at {:g} s {}", key.time, *problem));
}

void read_model(const json::Node& node, const InputFiles& files, SceneBuilder& builder,
                std::set<std::string>& names) {
    const KeyedNode keyed(node, {"translate", "rotate", "scale"}, {"name", "file", "material"});
    const json::Node file = node.require("file");
    if (lower_extension(file.text()) != ".obj") file.expected("a model in an .obj file");
    const auto path = files.find(node.file().parent_path(), file.text());
    if (!path) file.fail(fmt::format("no such file: {}", file.shown()));
    SceneBuilder::Placement placement{.name = path->stem().string(),
                                      .transform = read_transform(keyed),
                                      .material = std::nullopt};
    if (const auto name = node.find("name")) {
        placement.name = name->text();
        if (!names.insert(placement.name).second)
            name->fail(fmt::format("{} is the name of another model too", name->shown()));
    }
    if (const auto material = node.find("material")) {
        placement.material = material->text();
        if (!builder.entries().has(*placement.material))
            material->fail(
                fmt::format("no material {} in \"materials\"{}", material->shown(),
                            json::suggestion(*placement.material, builder.entries().names())));
    }
    builder.add_model(*path, std::move(placement));
}

void read_models(const json::Node& document, InputFiles& files, Scene& scene) {
    MaterialEntries entries;
    entries.read(document, files);
    SceneBuilder builder(scene, files, std::move(entries));
    if (const auto list = document.find("models")) {
        std::set<std::string> names;
        for (std::size_t i = 0; i < list->size(); ++i)
            read_model((*list)[i], files, builder, names);
    }
    builder.finish();
}

// Between its keys too an animation may make a light flat or turn the camera's eye through its
// target.
void check_animation(const Scene& scene) {
    const Animation& animation = scene.animation;
    const std::int64_t count = std::min<std::int64_t>(
        kCheckedFrames, std::int64_t{animation.last_frame} - animation.first_frame + 1);
    for (int i = 0; i < count; ++i) {
        const int frame = animation.first_frame + i;
        const double time = animation.seconds(frame);
        if (const auto problem = camera_problem(scene.camera, time))
            throw InputError(scene.file, "camera", fmt::format("at frame {} {}", frame, *problem));
        for (std::size_t k = 0; k < scene.lights.size(); ++k) {
            if (const auto problem = shape_problem(scene.lights[k].shape, time))
                throw InputError(scene.file, fmt::format("lights[{}]", k),
                                 fmt::format("at frame {} {}", frame, *problem));
        }
    }
}

void warn_of_darkness(Scene& scene) {
    if (scene.lights.empty() && scene.emitters.empty())
        scene.warnings.emplace_back("there is no light: no \"lights\", no emissive faces");
}

void read_document(const fs::path& file, std::string_view text, InputFiles& files, Scene& scene) {
    const json::Value value = json::parse(file, text);
    const json::Node document(file, value, "the document");
    document.allow(
        {"film", "camera", "models", "materials", "lights", "environment", "animation", "render"});
    read_film(document, scene);
    read_animation(document, scene);
    read_render(document, scene);
    read_environment(document, scene);
    scene.lights = read_lights(document);
    read_models(document, files, scene);
    read_camera(document, scene);
    check_animation(scene);
    warn_of_darkness(scene);
}

void read_model_alone(const fs::path& file, InputFiles& files, Scene& scene) {
    SceneBuilder builder(scene, files, {});
    builder.add_model(file, {.name = file.stem().string(),
                             .transform = {.translate = constant(Vec3f{0, 0, 0}),
                                           .scale = constant(Vec3f{1, 1, 1}),
                                           .rotate = constant(rotation_from_degrees({0, 0, 0}))},
                             .material = std::nullopt});
    builder.finish();
    scene.camera = framing_camera(scene);
    if (scene.emitters.empty()) scene.lights.push_back(default_light(scene));
}

}  // namespace

Scene read_scene(const fs::path& file) {
    const parallel::FlushDenormals flush;
    Scene scene;
    scene.file = file;
    InputFiles files;
    const std::string extension = lower_extension(file);
    if (extension == ".json") {
        read_document(file, files.read(file, json::kMaxDocumentBytes), files, scene);
    } else if (extension == ".obj") {
        read_model_alone(file, files, scene);
    } else {
        throw InputError(file, "expected a scene (.json) or a model (.obj)");
    }
    scene.files = files.read_files();
    return scene;
}

Scene read_scene_text(std::string_view text, const VirtualFiles& virtual_files) {
    const parallel::FlushDenormals flush;
    Scene scene;
    InputFiles files(&virtual_files);
    read_document("built-in scene", text, files, scene);
    scene.files = files.read_files();
    return scene;
}

}  // namespace penumbra
