#include "core/parallel/arena.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <xmmintrin.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "core/error.h"
#include "core/parallel/thread_limits.h"
#include "core/profile/profile.h"

namespace penumbra::parallel {
namespace {

// MXCSR: bit 15 flushes denormal results to zero, bit 6 reads denormal operands as zero.
constexpr unsigned kFlushDenormals = 0x8040;

std::string read_file(const char* path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

int default_thread_count() {
    const char* const slurm = std::getenv("SLURM_CPUS_PER_TASK");
    return combine_limits(
        affinity_count(),
        cgroup_quota(read_file("/proc/self/cgroup"), read_file("/proc/self/mountinfo"), "/"),
        slurm ? parse_thread_count(slurm) : std::nullopt);
}

FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) {
    _mm_setcsr(saved_ | kFlushDenormals);
}
FlushDenormals::~FlushDenormals() {
    // Only the two bits: exception flags raised meanwhile stay as they are.
    _mm_setcsr((_mm_getcsr() & ~kFlushDenormals) | (saved_ & kFlushDenormals));
}

// oneTBB never runs more threads than the host has cores unless told, and obeys the lowest of all
// limits alive: every arena asks for the same high one, and is bounded by its own size alone.
constexpr std::size_t kMaxThreads = 1024;

struct Arena::Implementation {
    explicit Implementation(int threads)
        : limit(tbb::global_control::max_allowed_parallelism,
                std::max(kMaxThreads, static_cast<std::size_t>(threads))),
          arena(threads) {}

    tbb::global_control limit;
    tbb::task_arena arena;
    profile::Profile* profile = nullptr;
};

Arena::Arena(int threads) {
    PENUMBRA_ASSERT(threads >= 1, "threads = {}", threads);
    implementation_ = std::make_unique<Implementation>(std::max(1, threads));
}
Arena::~Arena() = default;

int Arena::threads() const {
    return implementation_->arena.max_concurrency();
}

void Arena::record(profile::Profile* profile) {
    if (profile) profile->make_tracks(threads());
    implementation_->profile = profile;
}

void Arena::for_each(int count, const std::function<void(int, int)>& body,
                     const std::atomic<bool>* cancelled) const {
    profile::Profile* const profile = implementation_->profile;
    const char* const phase = profile ? profile->phase() : nullptr;
    const auto run_range = [&](const tbb::blocked_range<int>& range) {
        const FlushDenormals flush;
        const int worker = tbb::this_task_arena::current_thread_index();
        for (int index = range.begin(); index != range.end(); ++index) {
            if (cancelled && cancelled->load(std::memory_order_relaxed)) return;
            const profile::Scope task(profile, worker, profile::Kind::kTask, phase,
                                      {"index", index});
            body(index, worker);
        }
    };
    implementation_->arena.execute([&] {
        const profile::Scope loop(profile, tbb::this_task_arena::current_thread_index(),
                                  profile::Kind::kLoop, phase, {"count", count});
        // One index is a tile or a band: coarse enough to be a task of its own.
        tbb::parallel_for(tbb::blocked_range<int>(0, std::max(0, count), 1), run_range,
                          tbb::simple_partitioner{});
    });
}

void Arena::run(const std::function<void()>& body) const {
    implementation_->arena.execute([&] {
        const FlushDenormals flush;
        body();
    });
}

}  // namespace penumbra::parallel
