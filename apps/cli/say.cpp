#include "apps/cli/say.h"

#include "core/error.h"

namespace penumbra::cli {

void require_said() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        throw OutputError("standard output cannot be written");
}

}  // namespace penumbra::cli
