#include "apps/diff/pairs.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "core/error.h"

namespace penumbra::diff {
namespace {

namespace fs = std::filesystem;

bool is_pattern(const std::string& path) {
    return fs::path(path).filename().string().find('#') != std::string::npos;
}

// A file name with one run of '#'.
struct Pattern {
    fs::path folder;
    std::string before, after;
    std::size_t digits = 0;

    [[nodiscard]] fs::path file(const std::string& frame) const {
        return folder / (before + frame + after);
    }
};

Pattern parse_pattern(const std::string& path) {
    const fs::path whole(path);
    const std::string name = whole.filename().string();
    Pattern pattern{whole.parent_path(), {}, {}, 0};
    const std::size_t begin = name.find('#');
    const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
    if (name.find('#', end) != std::string::npos)
        throw InputError(path, "expected one run of '#' for the frame number");
    pattern.before = name.substr(0, begin);
    pattern.after = name.substr(end);
    pattern.digits = end - begin;
    return pattern;
}

bool is_frame_number(std::string_view text, std::size_t digits) {
    const bool is_negative = text.starts_with('-');
    const std::string_view number = text.substr(is_negative ? 1 : 0);
    // Padded to the pattern's length; longer numbers have no leading zero.
    if (text.size() < digits || number.empty()) return false;
    if (text.size() > digits && number.front() == '0' && number.size() > 1) return false;
    return std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::set<std::string> find_frames(const Pattern& pattern) {
    std::set<std::string> frames;
    std::error_code error;
    const fs::path folder = pattern.folder.empty() ? "." : pattern.folder;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (name.size() < pattern.before.size() + pattern.after.size() ||
            !name.starts_with(pattern.before) || !name.ends_with(pattern.after))
            continue;
        const std::string frame = name.substr(
            pattern.before.size(), name.size() - pattern.before.size() - pattern.after.size());
        if (is_frame_number(frame, pattern.digits)) frames.insert(frame);
    }
    return frames;
}

bool is_image_name(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".exr" || extension == ".hdr" || extension == ".png" ||
           extension == ".jpg" || extension == ".jpeg";
}

std::set<std::string> find_images(const std::string& folder) {
    std::set<std::string> images;
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder, error), end; at != end; at.increment(error)) {
        if (error) throw InputError(folder, "cannot be listed: " + error.message());
        if (at->is_regular_file() && is_image_name(at->path()))
            images.insert(at->path().lexically_relative(folder).generic_string());
    }
    return images;
}

enum class Kind { kFile, kPattern, kFolder };

Kind kind_of(const std::string& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return Kind::kFolder;
    return is_pattern(path) && !fs::exists(path, ignored) ? Kind::kPattern : Kind::kFile;
}

template <class Find>
std::set<std::string> names_of_both(const std::string& reference, const std::string& test,
                                    const Find& find, std::string_view expected) {
    std::set<std::string> names;
    for (const std::string& path : {reference, test}) {
        const std::set<std::string> found = find(path);
        if (found.empty()) throw InputError(path, fmt::format("expected {}, found none", expected));
        names.insert(found.begin(), found.end());
    }
    return names;
}

}  // namespace

std::vector<FilePair> find_pairs(const std::string& reference, const std::string& test) {
    const Kind kind = kind_of(reference);
    if (kind != kind_of(test)) {
        for (const std::string& path : {reference, test})
            if (!is_pattern(path) && !fs::exists(path))
                throw InputError(path, "there is no such file or folder");
        throw InputError(test, "expected two files, two patterns with '#' or two folders");
    }
    std::vector<FilePair> pairs;
    if (kind == Kind::kFile) return {{fs::path(reference).filename().string(), reference, test}};
    if (kind == Kind::kFolder) {
        for (const std::string& name :
             names_of_both(reference, test, find_images, "image files in the folder"))
            pairs.push_back({name, fs::path(reference) / name, fs::path(test) / name});
        return pairs;
    }
    const Pattern a = parse_pattern(reference), b = parse_pattern(test);
    const auto frames = names_of_both(
        reference, test, [](const std::string& p) { return find_frames(parse_pattern(p)); },
        "files with frame numbers");
    for (const std::string& frame : frames)
        pairs.push_back({a.before + frame + a.after, a.file(frame), b.file(frame)});
    return pairs;
}

}  // namespace penumbra::diff
