#include "apps/check/selection.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "core/error.h"

namespace penumbra::check {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSettingsEnding = ".check.json";
constexpr std::string_view kGolden = ".golden";
constexpr std::string_view kSceneEndings[] = {".json", ".obj"};

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

std::optional<std::string> without(std::string_view path, std::string_view ending) {
    if (path.size() <= ending.size() || !path.ends_with(ending)) return std::nullopt;
    return std::string(path.substr(0, path.size() - ending.size()));
}

// "shot" of "shot.golden.exr" and "shot.golden.0012.exr".
std::optional<std::string> check_of_golden(std::string_view path) {
    const auto stem = without(path, ".exr");
    if (!stem) return std::nullopt;
    if (auto name = without(*stem, kGolden)) return name;
    const std::size_t dot = stem->rfind('.');
    if (dot == std::string::npos || !is_frame_number(std::string_view(*stem).substr(dot + 1)))
        return std::nullopt;
    return without(stem->substr(0, dot), kGolden);
}

std::optional<std::string> check_marked_by(std::string_view path) {
    auto name = without(path, kSettingsEnding);
    return name ? name : check_of_golden(path);
}

// Checks by what tells them apart, whatever links and dots lead to them.
class Selection {
  public:
    void add(const std::string& name, fs::path scene = {}) {
        Check check{name, {}, std::move(scene)};
        if (is_file(name + std::string(kSettingsEnding)))
            check.settings = name + std::string(kSettingsEnding);
        for (const std::string_view ending : kSceneEndings)
            if (check.scene.empty() && is_file(name + std::string(ending)))
                check.scene = name + std::string(ending);
        std::error_code ignored;
        checks_.emplace(fs::weakly_canonical(name, ignored).string(), std::move(check));
    }
    [[nodiscard]] std::vector<Check> take() {
        std::vector<Check> checks;
        for (auto& [identity, check] : checks_) checks.push_back(std::move(check));
        std::sort(checks.begin(), checks.end(),
                  [](const Check& a, const Check& b) { return a.name < b.name; });
        return checks;
    }

  private:
    std::map<std::string, Check> checks_;
};

void search(const fs::path& folder, Selection& selection) {
    std::set<std::string> names;
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
         at.increment(error)) {
        const bool is_hidden = at->path().filename().string().starts_with('.');
        if (is_hidden && at->is_directory(error)) at.disable_recursion_pending();
        if (is_hidden || !is_file(at->path())) continue;
        if (const auto name = check_marked_by(at->path().lexically_normal().string()))
            names.insert(*name);
    }
    if (error) throw OutputError(folder, "cannot be listed: " + error.message());
    if (names.empty())
        throw InputError(folder,
                         "has nothing to check: expected scenes with NAME.check.json or "
                         "NAME.golden.exr beside NAME.json; name a scene itself to begin with it");
    for (const std::string& name : names) selection.add(name);
}

void add_file(const fs::path& path, Selection& selection) {
    const std::string text = path.lexically_normal().string();
    if (const auto name = check_marked_by(text)) return selection.add(*name);
    for (const std::string_view ending : kSceneEndings)
        if (const auto name = without(text, ending)) return selection.add(*name, text);
    throw InputError(path, "expected a scene (.json), a model (.obj), NAME.check.json or a folder");
}

}  // namespace

bool is_frame_number(std::string_view text) {
    if (text.starts_with('-')) text.remove_prefix(1);
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

fs::path golden_path(const std::string& check_name, const std::string& frame) {
    return fmt::format("{}{}{}{}.exr", check_name, kGolden, frame.empty() ? "" : ".", frame);
}

std::vector<fs::path> existing_goldens(const std::string& check_name) {
    std::vector<fs::path> goldens;
    const fs::path parent = fs::path(check_name).parent_path();
    std::error_code ignored;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(parent.empty() ? "." : parent, ignored)) {
        const fs::path path = parent / entry.path().filename();
        if (check_of_golden(path.string()) == check_name) goldens.push_back(path);
    }
    std::sort(goldens.begin(), goldens.end());
    return goldens;
}

std::vector<Check> find_checks(const std::vector<std::string>& paths) {
    Selection selection;
    for (const std::string& path : paths) {
        std::error_code ignored;
        if (fs::is_directory(path, ignored))
            search(path, selection);
        else if (is_file(path))
            add_file(path, selection);
        else
            throw InputError(path, "there is no such file or folder");
    }
    return selection.take();
}

std::vector<Check> filtered(std::vector<Check> checks, const std::vector<std::string>& filters) {
    if (filters.empty()) return checks;
    const auto is_unwanted = [&](const Check& check) {
        return std::none_of(filters.begin(), filters.end(), [&](const std::string& filter) {
            return fnmatch(("*" + filter + "*").c_str(), check.name.c_str(), 0) == 0;
        });
    };
    checks.erase(std::remove_if(checks.begin(), checks.end(), is_unwanted), checks.end());
    if (checks.empty()) throw InputError("--filter: no check has such a name; --list shows them");
    return checks;
}

}  // namespace penumbra::check
