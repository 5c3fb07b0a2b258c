#include "apps/diff/spool.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <span>
#include <vector>

#include "core/error.h"

namespace penumbra::diff {

Spool::Spool(const std::filesystem::path& target) : target_(target) {
    std::string name = target.string() + ".XXXXXX";
    descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0) fail("no temporary file can be created beside it");
    ::unlink(name.c_str());
}

Spool::~Spool() {
    ::close(descriptor_);
}

void Spool::fail(std::string_view what) const {
    throw OutputError(target_, fmt::format("{}: {}", what, std::strerror(errno)));
}

void Spool::append(std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(descriptor_, text.data(), text.size());
        if (count < 0 && errno != EINTR) fail("the temporary file beside it cannot be written");
        if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
    }
}

void Spool::copy_to(image::PendingFile& file) const {
    std::vector<std::uint8_t> piece(std::size_t{1} << 20);
    for (off_t at = 0;;) {
        const ssize_t count = ::pread(descriptor_, piece.data(), piece.size(), at);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail("the temporary file beside it cannot be read");
        if (count == 0) return;
        file.write(std::span(piece).first(static_cast<std::size_t>(count)));
        at += count;
    }
}

}  // namespace penumbra::diff
