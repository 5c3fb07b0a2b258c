#include "core/parallel/cgroup.h"

#include <algorithm>
#include <string>

#include "core/parallel/proc_text.h"

namespace penumbra::parallel {
namespace {

// Where a hierarchy is mounted, and which of its cgroups is seen there.
struct Mount {
    std::filesystem::path point;
    std::filesystem::path root;
    bool is_v2 = false;
};

bool contains(std::string_view list, std::string_view name) {
    const std::vector<std::string_view> names = split_words(list, ",");
    return std::find(names.begin(), names.end(), name) != names.end();
}

// proc(5), mountinfo: "id parent major:minor root point options [fields] - type source
// super-options".
std::vector<Mount> mounts_of(std::string_view mounts, std::string_view controller) {
    std::vector<Mount> found;
    for (const std::string_view line : split_words(mounts, "\n")) {
        const std::vector<std::string_view> words = split_words(line, " ");
        const auto dash = std::find(words.begin(), words.end(), "-");
        if (words.size() < 6 || words.end() - dash < 4) continue;
        const bool is_v2 = dash[1] == "cgroup2";
        if (is_v2 || (dash[1] == "cgroup" && contains(dash[3], controller)))
            found.push_back({.point = words[4], .root = words[3], .is_v2 = is_v2});
    }
    return found;
}

// cgroups(7), /proc/self/cgroup: "0::/path" for v2, "4:cpu,cpuacct:/path" for v1.
std::optional<std::filesystem::path> membership_path(std::string_view membership,
                                                     std::string_view controller, bool is_v2) {
    for (const std::string_view line : split_words(membership, "\n")) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', std::min(first, line.size() - 1) + 1);
        if (first == std::string_view::npos || second == std::string_view::npos) continue;
        const std::string_view controllers = line.substr(first + 1, second - first - 1);
        const bool matches = is_v2 ? controllers.empty() : contains(controllers, controller);
        if (matches) return std::filesystem::path(line.substr(second + 1));
    }
    return std::nullopt;
}

// A cgroup and its ancestors up to the mount point. In a container the path often lies outside of
// what is mounted (the mount shows the container's own cgroup as its top): then the walk starts at
// the deepest folder that exists, which is the mount point itself.
void add_folders(const Mount& mount, const std::filesystem::path& path,
                 const std::filesystem::path& root, std::vector<CgroupFolder>& folders) {
    const std::filesystem::path top = root / mount.point.relative_path();
    const std::filesystem::path below = path.lexically_relative(mount.root);
    const bool is_visible = !below.empty() && below != "." && *below.begin() != "..";
    std::filesystem::path folder = is_visible ? (top / below).lexically_normal() : top;
    folders.push_back({top, mount.is_v2});
    for (; folder != top && folder.string().size() > top.string().size();
         folder = folder.parent_path())
        folders.push_back({folder, mount.is_v2});
}

// Of lines "name number"; 0 where it is not there.
long long entry(std::string_view text, std::string_view name) {
    for (const std::string_view line : split_words(text, "\n")) {
        const std::vector<std::string_view> words = split_words(line, " ");
        if (words.size() == 2 && words[0] == name) return parse_integer(words[1]).value_or(0);
    }
    return 0;
}

std::optional<std::uint64_t> memory_left(const CgroupFolder& folder) {
    const auto number = [&](const char* v2, const char* v1) {
        return parse_integer(read_text(folder.path / (folder.is_v2 ? v2 : v1)));
    };
    const auto limit = number("memory.max", "memory.limit_in_bytes");  // "max" is not a number
    const auto used = number("memory.current", "memory.usage_in_bytes");
    if (!limit || !used) return std::nullopt;
    const long long cached = entry(read_text(folder.path / "memory.stat"),
                                   folder.is_v2 ? "inactive_file" : "total_inactive_file");
    return static_cast<std::uint64_t>(std::max(0LL, *limit - std::max(0LL, *used - cached)));
}

}  // namespace

std::vector<CgroupFolder> cgroup_folders(std::string_view membership, std::string_view mounts,
                                         std::string_view controller,
                                         const std::filesystem::path& root) {
    std::vector<CgroupFolder> folders;
    for (const Mount& mount : mounts_of(mounts, controller))
        if (const auto path = membership_path(membership, controller, mount.is_v2))
            add_folders(mount, *path, root, folders);
    return folders;
}

std::optional<std::uint64_t> cgroup_memory_left(const std::vector<CgroupFolder>& folders) {
    std::optional<std::uint64_t> least;
    for (const CgroupFolder& folder : folders)
        if (const auto left = memory_left(folder)) least = std::min(least.value_or(*left), *left);
    return least;
}

}  // namespace penumbra::parallel
