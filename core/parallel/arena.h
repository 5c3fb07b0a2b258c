#pragma once

#include <atomic>
#include <functional>
#include <memory>

// The one place that owns threads.

namespace penumbra::profile {
class Profile;
}

namespace penumbra::parallel {

// Threads to use when nobody says: the least of what the affinity mask, the cgroup quota (v1 and
// v2) and SLURM_CPUS_PER_TASK allow; at least 1.
[[nodiscard]] int default_thread_count();

// Sets flush-to-zero and denormals-are-zero for its lifetime: part of "same input, same bits".
class FlushDenormals {
  public:
    FlushDenormals();
    ~FlushDenormals();
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

  private:
    unsigned saved_;
};

// A fixed number of threads that run loops. Every body runs with denormals flushed.
class Arena {
  public:
    explicit Arena(int threads);
    ~Arena();
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    [[nodiscard]] int threads() const;

    // From now on every loop is recorded, and each call of its body on the track of its worker.
    // Null ends it. The profile must outlive that; loops must not run meanwhile.
    void record(profile::Profile* profile);

    // Calls body(index, worker) once for each index in [0, count), in any order; worker in
    // [0, threads()) is never used by two calls at once: it selects scratch memory. Returns when
    // all are done; rethrows the first exception. Where `cancelled` becomes true, the rest is
    // skipped.
    void for_each(int count, const std::function<void(int index, int worker)>& body,
                  const std::atomic<bool>* cancelled = nullptr) const;

    // Runs one function inside the arena, for libraries that use its threads themselves (Embree).
    void run(const std::function<void()>& body) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace penumbra::parallel
