#include "apps/check/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/error.h"

namespace penumbra::check {

TemporaryFolder::TemporaryFolder() {
    std::error_code error;
    const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
    if (error) throw OutputError("TMPDIR: " + error.message());
    std::string name = (parent / "penumbra-check-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw OutputError(name, std::strerror(errno));
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace penumbra::check
