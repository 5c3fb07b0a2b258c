#include "core/scene/input_files.h"

#include <algorithm>
#include <fstream>

#include "core/error.h"
#include "core/text_scan.h"

namespace penumbra {
namespace fs = std::filesystem;
namespace {

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool equal_but_for_case(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower(x) == lower(y); });
}

// "C:\textures\wood.png" -> "/textures/wood.png"
std::string with_slashes(std::string_view name) {
    std::string text(trimmed(name));
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
        text = text.substr(1, text.size() - 2);
    std::replace(text.begin(), text.end(), '\\', '/');
    const bool has_drive =
        text.size() >= 2 && text[1] == ':' && lower(text[0]) >= 'a' && lower(text[0]) <= 'z';
    if (has_drive) text.replace(0, 2, 1, '/');
    return text;
}

// The entry of a folder whose name differs in case alone: the first in the order of names, since
// the order of the directory is the disk's.
std::optional<fs::path> entry_any_case(const fs::path& folder, const fs::path& name) {
    std::optional<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        const fs::path entry = at->path().filename();
        if (equal_but_for_case(entry.string(), name.string()) && (!found || entry < *found))
            found = entry;
    }
    return found;
}

}  // namespace

void require_regular_file(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) throw InputError(file, "no such file");
    if (fs::is_directory(status)) throw InputError(file, "is a folder, expected a file");
    // Pipes and devices may never end, and the digest reads files a second time.
    if (!fs::is_regular_file(status)) throw InputError(file, "is a device, expected a file");
}

bool InputFiles::exists(const fs::path& file) const {
    if (virtual_) return virtual_->contains(file.lexically_normal().generic_string());
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    return fs::exists(status) && !fs::is_directory(status);
}

std::optional<fs::path> InputFiles::find_any_case(const fs::path& folder,
                                                  const fs::path& relative) const {
    if (exists(folder / relative)) return folder / relative;
    if (virtual_) return std::nullopt;
    fs::path path = folder;
    for (const fs::path& part : relative.lexically_normal()) {
        std::error_code error;
        if (part == ".." || fs::exists(path / part, error)) {
            path /= part;
        } else if (const auto entry = entry_any_case(path.empty() ? "." : path, part)) {
            path /= *entry;
        } else {
            return std::nullopt;
        }
    }
    if (!exists(path)) return std::nullopt;
    return path;
}

std::optional<fs::path> InputFiles::find(const fs::path& folder, std::string_view name) const {
    const fs::path path(with_slashes(name));
    if (!path.has_filename()) return std::nullopt;
    if (path.is_absolute()) {
        if (exists(path)) return path;
        if (auto file = find_any_case(folder, path.relative_path())) return file;
    } else if (auto file = find_any_case(folder, path)) {
        return file;
    }
    return find_any_case(folder, path.filename());
}

std::string InputFiles::read(const fs::path& file, std::size_t limit) {
    note(file);
    if (virtual_) {
        const auto found = virtual_->find(file.lexically_normal().generic_string());
        if (found == virtual_->end()) throw InputError(file, "no such file");
        return found->second;
    }
    require_regular_file(file);
    std::error_code unknown_size;
    if (const auto size = fs::file_size(file, unknown_size); !unknown_size && size > limit)
        throw InputError(file, fmt::format("{} bytes long, expected at most {}", size, limit));
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(file, "cannot be opened for reading");
    std::string content;
    std::string block(std::size_t{1} << 16, '\0');
    while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) ||
           stream.gcount() > 0)
        content.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (stream.bad()) throw OutputError(file, "reading failed");
    return content;
}

void InputFiles::note(const fs::path& file) {
    if (std::find(read_.begin(), read_.end(), file) == read_.end()) read_.push_back(file);
}

}  // namespace penumbra
