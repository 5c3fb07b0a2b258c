#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

// How many threads the surroundings allow, each source on its own: pure functions of their
// arguments, so that tests can hand them made-up machines. No value means "no limit from here".

namespace penumbra::parallel {

// Processors' worth of time that "max 100000" or "150000 100000" (cgroup v2: cpu.max) grants.
// Malformed text grants everything: a strange file system must not stop a render.
[[nodiscard]] std::optional<double> parse_cpu_max(std::string_view text);

// The same from cgroup v1's cpu.cfs_quota_us (-1: no limit) and cpu.cfs_period_us.
[[nodiscard]] std::optional<double> parse_cfs_quota(std::string_view quota,
                                                    std::string_view period);

// A positive decimal number, as SLURM_CPUS_PER_TASK holds one.
[[nodiscard]] std::optional<int> parse_thread_count(std::string_view text);

// The tightest quota over this process's cgroup and all its ancestors, in both versions of cgroups.
// `membership` is the text of /proc/self/cgroup, `mounts` that of /proc/self/mountinfo; paths in
// `mounts` are taken below `root` ("/" outside tests).
[[nodiscard]] std::optional<double> cgroup_quota(std::string_view membership,
                                                 std::string_view mounts,
                                                 const std::filesystem::path& root);

// Processors in this thread's affinity mask.
[[nodiscard]] int affinity_count();

// The least of all limits, quotas rounded up (a quota of 1.5 keeps two threads busy three quarters
// of the time), and at least 1.
[[nodiscard]] int combine_limits(int affinity, std::optional<double> quota,
                                 std::optional<int> slurm);

}  // namespace penumbra::parallel
