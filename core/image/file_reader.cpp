#include "core/image/file_reader.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.h"

namespace penumbra::image {

FileReader::FileReader(const std::filesystem::path& file) : path_(file) {
    // Not blocking: a pipe that nobody writes must not hang the program.
    descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) {
        throw InputError(file, fmt::format("cannot be read: {}", std::strerror(errno)));
    }
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
        ::close(descriptor_);
        throw InputError(file, S_ISDIR(status.st_mode) ? "is a folder, expected a file"
                                                       : "is not a regular file");
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
}

FileReader::FileReader(std::span<const std::uint8_t> content, std::filesystem::path name)
    : path_(std::move(name)), size_(content.size()), content_(content) {}

FileReader::~FileReader() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

bool FileReader::read_at(std::uint64_t offset, std::span<std::uint8_t> bytes) const {
    if (offset > size_ || bytes.size() > size_ - offset) return false;
    if (descriptor_ < 0) {
        std::copy_n(content_.begin() + static_cast<std::ptrdiff_t>(offset), bytes.size(),
                    bytes.begin());
        return true;
    }
    while (!bytes.empty()) {
        const ssize_t got =
            ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) {
            throw OutputError(path_, fmt::format("reading failed: {}", std::strerror(errno)));
        }
        if (got == 0) return false;  // became shorter since it was opened
        bytes = bytes.subspan(static_cast<std::size_t>(got));
        offset += static_cast<std::uint64_t>(got);
    }
    return true;
}

std::vector<std::uint8_t> read_whole_file(const std::filesystem::path& file) {
    const FileReader reader(file);
    std::vector<std::uint8_t> content(reader.size());
    if (!reader.read_at(0, content)) throw InputError(file, "became shorter while it was read");
    return content;
}

}  // namespace penumbra::image
