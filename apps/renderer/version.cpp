#include "apps/renderer/version.h"

namespace penumbra::renderer {

std::string_view version() {
    return PENUMBRA_VERSION;
}

}  // namespace penumbra::renderer
