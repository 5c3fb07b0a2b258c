#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/scene/read_scene.h"

// A folder with files of a scene, gone at the end of the test.
namespace penumbra::testing {

class SceneFolder {
  public:
    SceneFolder() {
        std::string name =
            (std::filesystem::temp_directory_path() / "penumbra-scene-XXXXXX").string();
        if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        path_ = name;
    }
    ~SceneFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    SceneFolder(const SceneFolder&) = delete;
    SceneFolder& operator=(const SceneFolder&) = delete;

    [[nodiscard]] std::filesystem::path operator/(std::string_view name) const {
        return path_ / name;
    }

    std::filesystem::path write(std::string_view name, std::string_view content) const {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << content;
        return file;
    }

    // The message of the InputError that reading the file gives, without the folder; "" if none.
    [[nodiscard]] std::string error_of(std::string_view name) const {
        try {
            static_cast<void>(read_scene(path_ / name));
        } catch (const InputError& error) {
            std::string message = error.what();
            for (std::size_t at; (at = message.find(path_.string() + "/")) != message.npos;)
                message.erase(at, path_.string().size() + 1);
            return message;
        }
        return "";
    }

    // The same of a scene file or a model with this content.
    [[nodiscard]] std::string error_of_json(std::string_view content) const {
        write("shot.json", content);
        return error_of("shot.json");
    }
    [[nodiscard]] std::string error_of_obj(std::string_view content) const {
        write("model.obj", content);
        return error_of("model.obj");
    }

  private:
    std::filesystem::path path_;
};

inline constexpr std::string_view kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

// A scene around given members: a camera, one triangle.
inline std::string scene_with(std::string_view members) {
    return fmt::format(R"({{"camera": {{"eye": [0, 0, 5], "target": [0, 0, 0]}},
"models": [{{"file": "triangle.obj"}}]{}{}}})",
                       members.empty() ? "" : ",\n", members);
}

inline Scene read_with(std::string_view members) {
    return read_scene_text(scene_with(members), {{"triangle.obj", std::string(kTriangleObj)}});
}

// A model alone, from memory: in a scene without a camera.
inline Scene read_obj_text(std::string_view obj, std::string_view mtl = "") {
    return read_scene_text(R"({"models": [{"file": "model.obj"}]})",
                           {{"model.obj", std::string(obj)}, {"model.mtl", std::string(mtl)}});
}

}  // namespace penumbra::testing
