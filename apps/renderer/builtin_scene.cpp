#include "apps/renderer/builtin_scene.h"

#include "apps/renderer/embedded_file.h"
#include "core/scene/digest.h"
#include "core/scene/read_scene.h"

namespace penumbra::renderer {

namespace {

constexpr const char* kSceneFile = "turntable.json";

VirtualFiles builtin_files() {
    VirtualFiles files;
    for (const EmbeddedFile& file : embedded_files()) files.emplace(file.name, file.content());
    return files;
}

}  // namespace

Scene read_builtin_scene() {
    const VirtualFiles files = builtin_files();
    return read_scene_text(files.at(kSceneFile), files);
}

std::string builtin_scene_digest() {
    const VirtualFiles files = builtin_files();
    return digest_of(files.at(kSceneFile), files).hex();
}

}  // namespace penumbra::renderer
