#include "apps/renderer/builtin_scene.h"

#include "apps/renderer/embedded_file.h"
#include "core/scene/read_scene.h"

namespace penumbra::renderer {

Scene read_builtin_scene() {
    VirtualFiles files;
    for (const EmbeddedFile& file : embedded_files()) files.emplace(file.name, file.content());
    return read_scene_text(files.at("turntable.json"), files);
}

}  // namespace penumbra::renderer
