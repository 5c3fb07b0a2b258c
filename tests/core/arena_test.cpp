#include "core/parallel/arena.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/parallel/thread_limits.h"
#include "core/parallel/tiles.h"

namespace penumbra::parallel {
namespace {

TEST_CASE("a loop visits each index once, whatever the number of threads") {
    for (const int threads : {1, 2, 3, 7}) {
        const Arena arena(threads);
        CHECK(arena.threads() == threads);
        std::vector<std::atomic<int>> visits(1000);
        arena.for_each(1000, [&](int index, int) { ++visits[static_cast<std::size_t>(index)]; });
        for (const std::atomic<int>& count : visits) REQUIRE(count == 1);
    }
}

TEST_CASE("no worker index is used by two calls at once") {
    const Arena arena(7);
    std::vector<std::atomic<int>> active(7);
    std::atomic<bool> is_clean = true;
    arena.for_each(2000, [&](int, int worker) {
        if (worker < 0 || worker >= 7 || ++active[static_cast<std::size_t>(worker)] != 1)
            is_clean = false;
        for (volatile int spin = 0; spin < 1000;) spin = spin + 1;
        --active[static_cast<std::size_t>(worker)];
    });
    CHECK(is_clean);
}

// Leaves the flush modes as they are by default while it lives.
class KeepDenormals {
  public:
    KeepDenormals() : saved_(__builtin_ia32_stmxcsr()) {
        __builtin_ia32_ldmxcsr(saved_ & ~0x8040u);
    }
    ~KeepDenormals() { __builtin_ia32_ldmxcsr(saved_); }

  private:
    unsigned saved_;
};

TEST_CASE("every body runs with denormals flushed, and the caller's mode comes back") {
    const KeepDenormals keep;
    volatile float tiny = 0x1p-70f;
    const Arena arena(3);
    std::atomic<int> unflushed = 0;
    const auto count_unflushed = [&] { unflushed += tiny * tiny != 0.0f; };
    arena.for_each(300, [&](int, int) { count_unflushed(); });
    arena.run(count_unflushed);
    CHECK(unflushed == 0);
    volatile float denormal = tiny * tiny;
    CHECK(denormal != 0.0f);
}

TEST_CASE("the first exception of a loop reaches the caller, and the arena lives on") {
    const Arena arena(2);
    const auto fail_at_17 = [](int index, int) {
        if (index == 17) throw std::runtime_error("seventeen");
    };
    CHECK_THROWS_WITH_AS(arena.for_each(100, fail_at_17), "seventeen", std::runtime_error);
    std::atomic<int> calls = 0;
    arena.for_each(10, [&](int, int) { ++calls; });
    CHECK(calls == 10);
}

TEST_CASE("a cancelled loop skips the rest") {
    const Arena arena(2);
    std::atomic<bool> cancelled = false;
    std::atomic<int> calls = 0;
    arena.for_each(
        100000,
        [&](int, int) {
            if (++calls == 10) cancelled = true;
        },
        &cancelled);
    CHECK(calls >= 10);
    CHECK(calls < 100);
}

TEST_CASE("an empty loop calls nothing") {
    const Arena arena(2);
    arena.for_each(0, [](int, int) { FAIL("called"); });
    arena.for_each(-3, [](int, int) { FAIL("called"); });
}

TEST_CASE("the text of cgroup quotas is read, and nonsense limits nothing") {
    CHECK(parse_cpu_max("150000 100000\n").value() == 1.5);
    CHECK_FALSE(parse_cpu_max("max 100000\n"));
    CHECK_FALSE(parse_cpu_max(""));
    CHECK_FALSE(parse_cpu_max("100000"));
    CHECK_FALSE(parse_cpu_max("100000 0"));
    CHECK_FALSE(parse_cpu_max("1e5 100000"));
    CHECK(parse_cfs_quota("50000\n", "100000\n").value() == 0.5);
    CHECK_FALSE(parse_cfs_quota("-1\n", "100000\n"));
    CHECK(parse_thread_count("12").value() == 12);
    for (const char* text : {"", "0", "-2", "4x", "4 4", "99999999999999999999"})
        CHECK_FALSE(parse_thread_count(text));
}

// A made-up file system below a folder of its own, removed at the end.
class FakeRoot {
  public:
    FakeRoot() {
        std::string pattern = (std::filesystem::temp_directory_path() / "penumbra-XXXXXX").string();
        REQUIRE(mkdtemp(pattern.data()) != nullptr);
        path = pattern;
    }
    ~FakeRoot() { std::filesystem::remove_all(path); }
    void write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((path / name).parent_path());
        std::ofstream(path / name) << text;
    }
    std::filesystem::path path;
};

constexpr const char* kMountsV2 =
    "22 1 0:2 / / rw - ext4 /dev/sda rw\n"
    "30 22 0:26 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n";

TEST_CASE("a quota of any ancestor of the cgroup counts (version 2)") {
    const FakeRoot root;
    root.write("sys/fs/cgroup/system.slice/cpu.max", "300000 100000\n");
    root.write("sys/fs/cgroup/system.slice/render.service/cpu.max", "max 100000\n");
    const std::string membership = "0::/system.slice/render.service\n";
    CHECK(cgroup_quota(membership, kMountsV2, root.path).value() == 3.0);
    root.write("sys/fs/cgroup/system.slice/render.service/cpu.max", "200000 100000\n");
    CHECK(cgroup_quota(membership, kMountsV2, root.path).value() == 2.0);
    CHECK_FALSE(cgroup_quota("0::/\n", kMountsV2, root.path));
}

TEST_CASE("inside a container the quota lies at the mount point") {
    const FakeRoot root;
    root.write("sys/fs/cgroup/cpu.max", "250000 100000\n");
    CHECK(cgroup_quota("0::/\n", kMountsV2, root.path).value() == 2.5);
    CHECK(cgroup_quota("0::/../outside\n", kMountsV2, root.path).value() == 2.5);
}

TEST_CASE("a quota of any ancestor of the cgroup counts (version 1)") {
    const FakeRoot root;
    const std::string mounts =
        "32 31 0:28 /docker/abc /sys/fs/cgroup/cpu,cpuacct rw - cgroup cgroup rw,cpu,cpuacct\n"
        "33 31 0:29 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n";
    const std::string membership = "5:memory:/docker/abc/job\n4:cpu,cpuacct:/docker/abc/job\n";
    root.write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "400000\n");
    root.write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000\n");
    CHECK(cgroup_quota(membership, mounts, root.path).value() == 4.0);
    root.write("sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_quota_us", "50000\n");
    root.write("sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_period_us", "50000\n");
    CHECK(cgroup_quota(membership, mounts, root.path).value() == 1.0);
}

TEST_CASE("strange descriptions of cgroups limit nothing") {
    const FakeRoot root;
    for (const char* text :
         {"", "\n", ":", "::", "0", "0:", "0::", "nonsense\n\n:::::\n", "- - - - - - -"})
        CHECK_FALSE(cgroup_quota(text, text, root.path));
    CHECK_FALSE(
        cgroup_quota("0::/a\n", "30 22 0:26 / /nowhere rw - cgroup2 cgroup2 rw\n", root.path));
}

TEST_CASE(
    "the tightest limit wins, part of a processor counts as one, and one thread is the least") {
    CHECK(combine_limits(8, std::nullopt, std::nullopt) == 8);
    CHECK(combine_limits(8, 1.5, std::nullopt) == 2);
    CHECK(combine_limits(8, 6.0, 3) == 3);
    CHECK(combine_limits(2, 6.0, 3) == 2);
    CHECK(combine_limits(8, 0.1, std::nullopt) == 1);
    CHECK(combine_limits(0, std::nullopt, std::nullopt) == 1);
    CHECK(default_thread_count() >= 1);
    CHECK(default_thread_count() <= affinity_count());
}

TEST_CASE("tiles cover a window once, on the full frame's grid") {
    const TileGrid grid(PixelRect{100, 70, 300, 129});
    CHECK(grid.columns == 4);
    CHECK(grid.rows == 2);
    int pixels = 0;
    for (int index = 0; index < grid.count(); ++index) {
        const Tile tile = grid.tile(index);
        CHECK(tile.index == index);
        CHECK(tile.x0 % kTileSize == 0);
        CHECK(tile.y0 % kTileSize == 0);
        pixels += grid.visible(tile).width() * grid.visible(tile).height();
    }
    CHECK(pixels == 200 * 59);
    CHECK(TileGrid(PixelRect{}).count() == 0);
    CHECK(TileGrid(PixelRect{-10, -64, 10, 0}).count() == 2);
}

TEST_CASE("every order visits each tile once, and a seed gives its own order") {
    const TileGrid grid(PixelRect{0, 0, 640, 300});
    const std::vector<int> rows = tile_sequence(grid, {});
    CHECK(rows[1] == 1);
    CHECK(tile_sequence(grid, {.kind = TileOrder::Kind::kMorton})[1] == 1);
    CHECK(tile_sequence(grid, {.kind = TileOrder::Kind::kMorton})[2] == grid.columns);
    const std::vector<int> shuffled = tile_sequence(grid, {TileOrder::Kind::kShuffled, 1});
    CHECK(shuffled != rows);
    CHECK(shuffled == tile_sequence(grid, {TileOrder::Kind::kShuffled, 1}));
    CHECK(shuffled != tile_sequence(grid, {TileOrder::Kind::kShuffled, 2}));
    const Arena arena(3);
    for (const auto kind :
         {TileOrder::Kind::kRows, TileOrder::Kind::kMorton, TileOrder::Kind::kShuffled}) {
        std::vector<std::atomic<int>> visits(static_cast<std::size_t>(grid.count()));
        for_each_tile(arena, grid, {kind, 5}, [&](const Tile& tile, int) {
            ++visits[static_cast<std::size_t>(tile.index)];
        });
        for (const std::atomic<int>& count : visits) CHECK(count == 1);
    }
}

}  // namespace
}  // namespace penumbra::parallel
