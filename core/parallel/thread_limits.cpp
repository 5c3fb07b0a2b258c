#include "core/parallel/thread_limits.h"

#include <sched.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace penumbra::parallel {
namespace {

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
    std::vector<std::string_view> words;
    while (true) {
        const std::size_t begin = text.find_first_not_of(separators);
        if (begin == std::string_view::npos) return words;
        text.remove_prefix(begin);
        const std::size_t end = std::min(text.find_first_of(separators), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
}

std::optional<long long> parse_integer(std::string_view text) {
    const std::vector<std::string_view> words = split(text, " \t\r\n");
    if (words.size() != 1) return std::nullopt;
    const char* const end = words[0].data() + words[0].size();
    long long value = 0;
    const auto [stop, error] = std::from_chars(words[0].data(), end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
}

std::optional<double> ratio(std::optional<long long> quota, std::optional<long long> period) {
    if (!quota || !period || *quota <= 0 || *period <= 0) return std::nullopt;
    return static_cast<double>(*quota) / static_cast<double>(*period);
}

std::string read_file(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void tighten(std::optional<double>& limit, std::optional<double> other) {
    if (other) limit = limit ? std::min(*limit, *other) : *other;
}

// Where a hierarchy is mounted, and which of its cgroups is seen there.
struct Mount {
    std::filesystem::path point;
    std::filesystem::path root;
    bool is_v2 = false;
};

bool contains(std::string_view list, std::string_view name) {
    const std::vector<std::string_view> names = split(list, ",");
    return std::find(names.begin(), names.end(), name) != names.end();
}

// proc(5), mountinfo: "id parent major:minor root point options [fields] - type source
// super-options".
std::vector<Mount> cpu_mounts(std::string_view mounts) {
    std::vector<Mount> found;
    for (const std::string_view line : split(mounts, "\n")) {
        const std::vector<std::string_view> words = split(line, " ");
        const auto dash = std::find(words.begin(), words.end(), "-");
        if (words.size() < 6 || words.end() - dash < 4) continue;
        const bool is_v2 = dash[1] == "cgroup2";
        if (is_v2 || (dash[1] == "cgroup" && contains(dash[3], "cpu")))
            found.push_back({.point = words[4], .root = words[3], .is_v2 = is_v2});
    }
    return found;
}

// cgroups(7), /proc/self/cgroup: "0::/path" for v2, "4:cpu,cpuacct:/path" for v1.
std::optional<std::filesystem::path> membership_path(std::string_view membership, bool is_v2) {
    for (const std::string_view line : split(membership, "\n")) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', std::min(first, line.size() - 1) + 1);
        if (first == std::string_view::npos || second == std::string_view::npos) continue;
        const std::string_view controllers = line.substr(first + 1, second - first - 1);
        const bool matches = is_v2 ? controllers.empty() : contains(controllers, "cpu");
        if (matches) return std::filesystem::path(line.substr(second + 1));
    }
    return std::nullopt;
}

std::optional<double> quota_of(const std::filesystem::path& folder, bool is_v2) {
    if (is_v2) return parse_cpu_max(read_file(folder / "cpu.max"));
    return parse_cfs_quota(read_file(folder / "cpu.cfs_quota_us"),
                           read_file(folder / "cpu.cfs_period_us"));
}

// The limits of a cgroup and its ancestors up to the mount point. In a container the path often
// lies outside of what is mounted (the mount shows the container's own cgroup as its top): then the
// walk starts at the deepest folder that exists, which is the mount point itself.
std::optional<double> tightest_quota(const Mount& mount, const std::filesystem::path& path,
                                     const std::filesystem::path& root) {
    const std::filesystem::path top = root / mount.point.relative_path();
    const std::filesystem::path below = path.lexically_relative(mount.root);
    const bool is_visible = !below.empty() && *below.begin() != "..";
    std::filesystem::path folder = is_visible ? (top / below).lexically_normal() : top;
    std::optional<double> limit = quota_of(top, mount.is_v2);
    for (; folder != top && folder.string().size() > top.string().size();
         folder = folder.parent_path())
        tighten(limit, quota_of(folder, mount.is_v2));
    return limit;
}

}  // namespace

std::optional<double> parse_cpu_max(std::string_view text) {
    const std::vector<std::string_view> words = split(text, " \t\r\n");
    if (words.size() != 2) return std::nullopt;  // includes the root cgroup, which has no such file
    return ratio(parse_integer(words[0]), parse_integer(words[1]));  // "max" is not a number
}

std::optional<double> parse_cfs_quota(std::string_view quota, std::string_view period) {
    return ratio(parse_integer(quota), parse_integer(period));
}

std::optional<int> parse_thread_count(std::string_view text) {
    const std::optional<long long> value = parse_integer(text);
    if (!value || *value < 1 || *value > 1 << 20) return std::nullopt;
    return static_cast<int>(*value);
}

std::optional<double> cgroup_quota(std::string_view membership, std::string_view mounts,
                                   const std::filesystem::path& root) {
    std::optional<double> limit;
    for (const Mount& mount : cpu_mounts(mounts))
        if (const auto path = membership_path(membership, mount.is_v2))
            tighten(limit, tightest_quota(mount, *path, root));
    return limit;
}

int affinity_count() {
    // The mask's size is the kernel's, which may be larger than cpu_set_t: grow until it fits.
    for (int processors = CPU_SETSIZE; processors <= 1 << 20; processors *= 2) {
        const std::size_t size = CPU_ALLOC_SIZE(static_cast<std::size_t>(processors));
        cpu_set_t* const set = CPU_ALLOC(static_cast<std::size_t>(processors));
        const bool fits = sched_getaffinity(0, size, set) == 0;
        const int count = fits ? CPU_COUNT_S(size, set) : 0;
        CPU_FREE(set);
        if (fits) return std::max(1, count);
    }
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

int combine_limits(int affinity, std::optional<double> quota, std::optional<int> slurm) {
    int threads = affinity;
    if (quota) threads = std::min(threads, static_cast<int>(std::ceil(std::min(*quota, 1e6))));
    if (slurm) threads = std::min(threads, *slurm);
    return std::max(1, threads);
}

}  // namespace penumbra::parallel
