#include "core/parallel/thread_limits.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

#include "core/parallel/cgroup.h"
#include "core/parallel/proc_text.h"

namespace penumbra::parallel {
namespace {

std::optional<double> ratio(std::optional<long long> quota, std::optional<long long> period) {
    if (!quota || !period || *quota <= 0 || *period <= 0) return std::nullopt;
    return static_cast<double>(*quota) / static_cast<double>(*period);
}

void tighten(std::optional<double>& limit, std::optional<double> other) {
    if (other) limit = limit ? std::min(*limit, *other) : *other;
}

std::optional<double> quota_of(const CgroupFolder& folder) {
    if (folder.is_v2) return parse_cpu_max(read_text(folder.path / "cpu.max"));
    return parse_cfs_quota(read_text(folder.path / "cpu.cfs_quota_us"),
                           read_text(folder.path / "cpu.cfs_period_us"));
}

}  // namespace

std::optional<double> parse_cpu_max(std::string_view text) {
    const std::vector<std::string_view> words = split_words(text, " \t\r\n");
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
    for (const CgroupFolder& folder : cgroup_folders(membership, mounts, "cpu", root))
        tighten(limit, quota_of(folder));
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
