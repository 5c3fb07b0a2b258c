#pragma once

#include <filesystem>
#include <string_view>

#include "core/image/publish.h"

namespace penumbra::diff {

// Text that waits on the disk for its place in a file: memory does not grow with it. It has no
// name, so nothing is left behind whatever happens.
class Spool {
  public:
    // Beside `target`, where there has to be room anyway. Throws OutputError, as all of this does.
    explicit Spool(const std::filesystem::path& target);
    ~Spool();
    Spool(const Spool&) = delete;
    Spool& operator=(const Spool&) = delete;

    void append(std::string_view text);
    void copy_to(image::PendingFile& file) const;

  private:
    [[noreturn]] void fail(std::string_view what) const;

    std::filesystem::path target_;
    int descriptor_ = -1;
};

}  // namespace penumbra::diff
