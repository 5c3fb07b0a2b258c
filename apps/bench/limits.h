#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/bench/floors.h"
#include "apps/bench/peaks.h"
#include "apps/bench/report.h"
#include "apps/bench/workload.h"
#include "apps/renderer/pass_table.h"
#include "core/profile/profile.h"

// The machine's limits for one frame and one number of threads, each measured by a loop of its own.

namespace penumbra::bench {

// How long a loop takes: on the wall clock, and its tasks of all threads together.
struct LoopTime {
    double wall_milliseconds = 0;
    double thread_milliseconds = 0;
};

// What a frame's pass must move or compute at least: bytes or multiply-adds.
[[nodiscard]] std::uint64_t demand(const renderer::PassInfo& pass, const Workload& work);

// How rays and bytes are handed over, by name ("stream", "around the caches"); of those that are
// empty or unknown here the quickest is looked for. Launches that are compared must not differ in
// what their limits mean.
struct LimitCalls {
    std::string primary, shadow, stream;
};
// Those of a report, where it has that scene and number of threads.
[[nodiscard]] LimitCalls limit_calls(const Report& report, const std::string& scene, int threads);

struct LimitSettings {
    simd::Isa isa;
    LimitCalls calls;
    const std::atomic<bool>* cancelled = nullptr;  // where it becomes true, times mean nothing
};

class Limits {
  public:
    struct Measured {
        LoopTime primary_rays, shadow_rays;
        std::array<LoopTime, renderer::kPassCount> own{};  // of streams and arithmetic, by pass
        // The loop that bounds a pass; zeros where nothing does.
        [[nodiscard]] const LoopTime& of(const renderer::PassInfo& pass) const;
    };

    // `workload`, `bare`, `arena` and `profile`, which the arena records to, must outlive it. Finds
    // the quickest call for each by trying all, unless the settings name it.
    Limits(const Workload& workload, const shadow::BareRays& bare, const LimitSettings& settings,
           const parallel::Arena& arena, profile::Profile& profile);

    // All of them once.
    [[nodiscard]] Measured measure();
    // The least of all times that measure() returned (at least one); rays by the tile, from the
    // slices of all those calls.
    [[nodiscard]] Measured floors(const Floors& tasks) const;

    // "stream", "8-packets", "around the caches", "avx512".
    [[nodiscard]] std::string primary_call() const { return name(primary_call_); }
    [[nodiscard]] std::string shadow_call() const { return name(shadow_call_); }
    [[nodiscard]] std::string stream_call() const;
    [[nodiscard]] std::string arithmetic_call() const { return std::string(simd::name(isa_)); }

  private:
    [[nodiscard]] bool is_cancelled() const { return cancelled_ && cancelled_->load(); }
    Measured measure_once();
    LoopTime primary(shadow::RayCall call);
    LoopTime shadow(shadow::RayCall call);
    // What must be moved (kStream) or computed (kArithmetic) for one pass. A loop that is over in
    // no time is run several times, until it can be measured.
    struct Loop {
        const renderer::PassInfo* pass;
        std::uint64_t multiply_adds;
        std::unique_ptr<Triad> triad;  // of a stream
        int rounds = 1;
    };
    void make_loops(LimitKind kind);
    Loop& loop_of(renderer::Pass pass);
    LoopTime stream(Loop& loop, StreamStores stores, const char* name);
    LoopTime run(Loop& loop);

    const Workload& work_;
    const shadow::BareRays& bare_;
    simd::Isa isa_;
    const std::atomic<bool>* cancelled_;
    const parallel::Arena& arena_;
    profile::Profile& profile_;
    std::vector<shadow::RayCallScratch> scratch_;  // one per worker
    std::vector<Loop> loops_;
    std::optional<Measured> least_;  // of all that measure() returned
    shadow::RayCall primary_call_ = shadow::RayCall::kSingle;
    shadow::RayCall shadow_call_ = shadow::RayCall::kSingle;
    StreamStores stores_ = StreamStores::kThroughCaches;
};

}  // namespace penumbra::bench
