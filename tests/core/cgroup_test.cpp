#include "core/parallel/cgroup.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

using namespace penumbra::parallel;

namespace {

// A made-up file system below a folder of its own, removed at the end.
class MadeUpRoot {
  public:
    MadeUpRoot() {
        std::string pattern = (std::filesystem::temp_directory_path() / "penumbra-XXXXXX").string();
        REQUIRE(mkdtemp(pattern.data()) != nullptr);
        path = pattern;
    }
    ~MadeUpRoot() { std::filesystem::remove_all(path); }
    void write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((path / name).parent_path());
        std::ofstream(path / name) << text;
    }
    std::filesystem::path path;
};

constexpr const char* kMountsV2 =
    "30 22 0:26 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n";

}  // namespace

TEST_CASE("the tightest cgroup says how much memory is left (version 2)") {
    const MadeUpRoot root;
    const auto folders = cgroup_folders("0::/ci/job\n", kMountsV2, "memory", root.path);
    CHECK_FALSE(cgroup_memory_left(folders));
    root.write("sys/fs/cgroup/ci/memory.max", "5000\n");
    root.write("sys/fs/cgroup/ci/memory.current", "1000\n");
    CHECK(cgroup_memory_left(folders).value() == 4000);
    root.write("sys/fs/cgroup/ci/job/memory.max", "3000\n");
    root.write("sys/fs/cgroup/ci/job/memory.current", "2000\n");
    root.write("sys/fs/cgroup/ci/job/memory.stat", "anon 7\ninactive_file 500\nactive_file 9\n");
    CHECK(cgroup_memory_left(folders).value() == 1500);
    root.write("sys/fs/cgroup/ci/job/memory.max", "max\n");
    CHECK(cgroup_memory_left(folders).value() == 4000);
}

TEST_CASE("a cgroup that is over its limit leaves nothing") {
    const MadeUpRoot root;
    root.write("sys/fs/cgroup/memory.max", "1000\n");
    root.write("sys/fs/cgroup/memory.current", "1200\n");
    const auto folders = cgroup_folders("0::/\n", kMountsV2, "memory", root.path);
    CHECK(cgroup_memory_left(folders).value() == 0);
}

TEST_CASE("memory has a hierarchy of its own in version 1") {
    const MadeUpRoot root;
    const std::string mounts =
        "32 31 0:28 / /sys/fs/cgroup/cpu rw - cgroup cgroup rw,cpu,cpuacct\n"
        "33 31 0:29 /docker/abc /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n";
    root.write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9000\n");
    root.write("sys/fs/cgroup/memory/memory.usage_in_bytes", "4000\n");
    root.write("sys/fs/cgroup/memory/memory.stat", "total_inactive_file 1000\n");
    const auto folders =
        cgroup_folders("5:memory:/docker/abc\n4:cpu:/x\n", mounts, "memory", root.path);
    REQUIRE(folders.size() == 1);
    CHECK(cgroup_memory_left(folders).value() == 6000);
}
