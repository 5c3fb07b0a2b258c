#include "core/image/publish.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "core/image/exr.h"

namespace penumbra::image {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, std::string_view what, int error) {
    throw OutputError(file, fmt::format("{}: {}", what, std::strerror(error)));
}

void create_folder(const std::filesystem::path& folder) {
    std::error_code error;
    if (!folder.empty()) std::filesystem::create_directories(folder, error);
    if (error) throw OutputError(folder, "the folder cannot be created: " + error.message());
}

void refuse_odd_targets(const std::filesystem::path& target) {
    std::error_code error;
    const auto type = std::filesystem::status(target, error).type();
    if (type == std::filesystem::file_type::directory) {
        throw OutputError(target, "is a folder, expected the name of a file");
    }
    if (type != std::filesystem::file_type::regular &&
        type != std::filesystem::file_type::not_found && type != std::filesystem::file_type::none) {
        throw OutputError(target, "exists and is not a regular file");
    }
}

// What a link points to is written, not the link: it may be one of the system's, or of a store.
std::filesystem::path followed(std::filesystem::path target) {
    std::error_code error;
    if (!std::filesystem::is_symlink(target, error)) return target;
    std::filesystem::path end = std::filesystem::weakly_canonical(target, error);
    return error ? target : end;
}

// Does the name still mean the file that was opened, and not one that somebody renamed meanwhile?
bool still_names(const std::filesystem::path& path, int descriptor) {
    struct stat by_name {
    }, by_descriptor{};
    return ::stat(path.c_str(), &by_name) == 0 && ::fstat(descriptor, &by_descriptor) == 0 &&
           by_name.st_dev == by_descriptor.st_dev && by_name.st_ino == by_descriptor.st_ino;
}

// Opens and locks; emptied only under the lock, since until then it may be another process's.
int open_locked(const std::filesystem::path& partial) {
    while (true) {
        const int descriptor = ::open(partial.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0) fail(partial, "cannot be created", errno);
        // File systems without locks (some network ones) answer with other errors: then go on
        // unlocked.
        if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            ::close(descriptor);
            throw OutputError(partial, "another process is writing this file");
        }
        if (!still_names(partial, descriptor)) {
            ::close(descriptor);
            continue;
        }
        if (::ftruncate(descriptor, 0) == 0) return descriptor;
        const int error = errno;
        ::close(descriptor);
        fail(partial, "cannot be emptied", error);
    }
}

// Makes a renaming survive a power failure. File systems that cannot flush a folder say EINVAL.
void flush_folder(const std::filesystem::path& folder) {
    const int descriptor =
        ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;  // a folder that may be written but not read
    const int result = ::fsync(descriptor);
    const int error = errno;
    ::close(descriptor);
    if (result != 0 && error != EINVAL && error != EROFS) {
        fail(folder, "the folder cannot be flushed to disk", error);
    }
}

}  // namespace

PendingFile::PendingFile(std::filesystem::path target) : target_(followed(std::move(target))) {
    partial_ = target_;
    partial_ += ".part";
    create_folder(target_.parent_path());
    refuse_odd_targets(target_);
    descriptor_ = open_locked(partial_);
}

PendingFile::~PendingFile() {
    if (descriptor_ < 0) return;
    ::unlink(partial_.c_str());  // before the lock goes with the descriptor
    ::close(descriptor_);
}

void PendingFile::write(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR) fail(partial_, "cannot be written", errno);
        if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void PendingFile::publish() {
    PENUMBRA_ASSERT(descriptor_ >= 0, "{} was published before", target_.string());
    if (::fsync(descriptor_) != 0) fail(partial_, "cannot be flushed to disk", errno);
    if (std::rename(partial_.c_str(), target_.c_str()) != 0) {
        fail(target_, "the finished file cannot be given its name", errno);
    }
    ::close(std::exchange(descriptor_, -1));
    flush_folder(target_.parent_path());
}

void require_complete(const std::filesystem::path& exr_file) {
    try {
        const ExrHeader header = read_exr_header(exr_file);
        if (header.is_complete()) return;
        throw OutputError(exr_file,
                          fmt::format("is incomplete: {} of {} blocks of pixels are missing",
                                      header.missing_chunks, header.chunks));
    } catch (const InputError& error) {
        // What we wrote ourselves cannot be read: that is the disk's failure, not the user's.
        throw OutputError(fmt::format("{} (while checking the file just written)", error.what()));
    }
}

void write_file_atomically(const std::filesystem::path& target,
                           std::span<const std::uint8_t> bytes) {
    PendingFile file(target);
    file.write(bytes);
    file.publish();
}

void write_file_atomically(const std::filesystem::path& target, std::string_view text) {
    write_file_atomically(
        target, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace penumbra::image
