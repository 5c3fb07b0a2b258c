#include "apps/bench/core_share.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

#include "apps/bench/arithmetic_kernel.h"
#include "core/profile/stopwatch.h"

namespace penumbra::bench {
namespace {

constexpr int kTrials = 5;
// About 50 microseconds each.
constexpr int kDependent = 40000;
constexpr int kTable = 2048;  // floats, 8 KiB
constexpr int kTableRounds = 400;

// In whole cache lines: loads that straddle two cost more.
struct alignas(64) Table {
    float floats[kTable];
};

template <class Body>
double seconds_of(const Body& body) {
    const profile::Stopwatch watch;
    body();
    return watch.seconds();
}

// Of the calling thread.
double share_here(const Table& table, std::atomic<float>& kept) {
    std::array<double, kTrials> shares{};
    for (double& share : shares) {
        const double waiting =
            seconds_of([&] { kept = avx2::dependent_multiply_adds(kDependent, 1.0f); });
        const double filling =
            seconds_of([&] { kept = avx2::table_sums(table.floats, kTable, kTableRounds); });
        share = waiting / filling;
    }
    // The middle one: interruptions meet either loop.
    std::nth_element(shares.begin(), shares.begin() + kTrials / 2, shares.end());
    return shares[kTrials / 2];
}

}  // namespace

double core_share(const parallel::Arena& arena) {
    static const Table table{};
    std::atomic<float> kept = 0;  // so that no compiler finds the loops useless
    std::vector<double> shares(static_cast<std::size_t>(arena.threads()));
    arena.for_each(arena.threads(), [&](int index, int) {
        shares[static_cast<std::size_t>(index)] = share_here(table, kept);
    });
    return *std::min_element(shares.begin(), shares.end());
}

}  // namespace penumbra::bench
