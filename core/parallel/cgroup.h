#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

// Where the limits that bind this process stand, in both versions of cgroups.

namespace penumbra::parallel {

struct CgroupFolder {
    std::filesystem::path path;
    bool is_v2 = false;
};

// This process's cgroup and all its ancestors that can be seen, as far as they have `controller`
// ("cpu", "memory"). `membership` is the text of /proc/self/cgroup, `mounts` that of
// /proc/self/mountinfo; paths in `mounts` are taken below `root` ("/" outside tests).
[[nodiscard]] std::vector<CgroupFolder> cgroup_folders(std::string_view membership,
                                                       std::string_view mounts,
                                                       std::string_view controller,
                                                       const std::filesystem::path& root);

// Bytes that these cgroups leave to this process: the least of limit - use, where pages that only
// cache files do not count as used.
[[nodiscard]] std::optional<std::uint64_t> cgroup_memory_left(
    const std::vector<CgroupFolder>& folders);

}  // namespace penumbra::parallel
