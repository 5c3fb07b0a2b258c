#include "apps/bench/limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/profile/stopwatch.h"
#include "core/profile/timeline.h"

namespace penumbra::bench {
namespace {

LoopTime scaled(LoopTime time, double factor) {
    return {.wall_milliseconds = factor * time.wall_milliseconds,
            .thread_milliseconds = factor * time.thread_milliseconds};
}

// Runs `body` as a phase of that name, `rounds` times; the arena records its loops' tasks.
template <class Body>
LoopTime timed(profile::Profile& profile, const char* name, int rounds, const Body& body) {
    const profile::Nanoseconds before = total(profile, profile::Kind::kTask, name);
    const profile::Phase phase(&profile, name);
    const profile::Stopwatch watch;
    for (int round = 0; round < rounds; ++round) body();
    const double seconds = watch.seconds();
    const profile::Nanoseconds tasks = total(profile, profile::Kind::kTask, name) - before;
    return scaled({.wall_milliseconds = 1e3 * seconds,
                   .thread_milliseconds = 1e-6 * static_cast<double>(tasks)},
                  1.0 / rounds);
}

// Phases whose tasks floors are made of.
constexpr const char* kPrimaryRaysPhase = "limit: primary rays";
constexpr const char* kShadowRaysPhase = "limit: shadow rays";

// Shorter ones drown in what else goes on in the machine.
constexpr double kLeastMilliseconds = 4;
constexpr int kMostRounds = 64;

// How often a loop must run that takes that long once.
int rounds_for(double milliseconds) {
    return std::clamp(
        static_cast<int>(std::ceil(kLeastMilliseconds / std::max(milliseconds, 1e-3))), 1,
        kMostRounds);
}

// The one of `candidates` that is quickest in the middle one of three trials.
template <class Candidate, class Time>
Candidate quickest(const std::vector<Candidate>& candidates, const Time& time) {
    Candidate best = candidates.front();
    double best_milliseconds = std::numeric_limits<double>::infinity();
    for (const Candidate candidate : candidates) {
        std::vector<double> trials;
        for (int trial = 0; trial < 3; ++trial) trials.push_back(time(candidate).wall_milliseconds);
        const double milliseconds = summarize(trials).median;
        if (milliseconds >= best_milliseconds) continue;
        best_milliseconds = milliseconds;
        best = candidate;
    }
    return best;
}

std::string text(StreamStores stores) {
    return stores == StreamStores::kAroundCaches ? "around the caches" : "through the caches";
}
std::string text(shadow::RayCall call) {
    return shadow::name(call);
}

// The one of `candidates` with that name, else the quickest.
template <class Candidate, class Time>
Candidate choose(const std::vector<Candidate>& candidates, const std::string& name,
                 const Time& time) {
    for (const Candidate candidate : candidates)
        if (text(candidate) == name) return candidate;
    return quickest(candidates, time);
}

}  // namespace

LimitCalls limit_calls(const Report& report, const std::string& scene, int threads) {
    LimitCalls calls;
    for (const SceneResult& result : report.scenes)
        for (const ThreadRun& run : result.runs) {
            if (result.name != scene || run.threads != threads) continue;
            for (const PassResult& pass : run.passes) {
                if (pass.limit == LimitKind::kPrimaryRays) calls.primary = pass.limit_call;
                if (pass.limit == LimitKind::kShadowRays) calls.shadow = pass.limit_call;
                if (pass.limit == LimitKind::kStream) calls.stream = pass.limit_call;
            }
        }
    return calls;
}

Demands demands(const Workload& work) {
    constexpr std::uint64_t kFloat = 4;
    // Positions and indices in, a reference per triangle and bin out.
    constexpr std::uint64_t kPosition = 3 * kFloat, kIndices = 3 * kFloat, kReference = 4;
    // Planes: U, S, U_N and emission of three channels each, coverage, depth, a normal.
    constexpr std::uint64_t kDeposited = 17;
    // S, U_N and U in, E out.
    constexpr std::uint64_t kNoise = 10;
    // Across: E, depth, normal, S and U_N in, S and U_N out. Down: the same in, with U and
    // emission, the picture out.
    constexpr std::uint64_t kFiltered = (5 + 6 + 6) + (5 + 6 + 6 + 3);
    // Two lobes. A vertex: a transform (9), and its edge's dot and cross product, length and
    // theta / sin theta (20). A pixel: two rows of 8 numbers of the table, interpolated in two
    // directions (32).
    constexpr std::uint64_t kPerVertex = 2 * (9 + 20), kPerPair = 32;
    // A ray: its place on a spherical triangle (60), the BRDF with its densities (40).
    constexpr std::uint64_t kPerRay = 100;
    return {.setup_bytes = kPosition * work.vertices + (kIndices + kReference) * work.triangles,
            .deposit_bytes = kDeposited * kFloat * work.pixels,
            .noise_bytes = kNoise * kFloat * work.pixels,
            .filter_bytes = kFiltered * kFloat * work.pixels,
            .shade_multiply_adds = kPerVertex * work.shaded_vertices + kPerPair * work.shaded_pairs,
            .rays_multiply_adds = kPerRay * work.shadow_rays};
}

Limits::Limits(const Workload& workload, const shadow::BareRays& bare,
               const LimitSettings& settings, const parallel::Arena& arena,
               profile::Profile& profile)
    : work_(workload),
      bare_(bare),
      isa_(settings.isa),
      cancelled_(settings.cancelled),
      arena_(arena),
      profile_(profile),
      demands_(demands(workload)),
      scratch_(static_cast<std::size_t>(arena.threads())),
      setup_(demands_.setup_bytes),
      deposit_(demands_.deposit_bytes),
      noise_(demands_.noise_bytes),
      filter_(demands_.filter_bytes),
      shade_{demands_.shade_multiply_adds},
      rays_{demands_.rays_multiply_adds} {
    using Stores = StreamStores;
    const LimitCalls& calls = settings.calls;
    primary_call_ =
        choose(shadow::intersect_calls(), calls.primary, [&](auto c) { return primary(c); });
    shadow_call_ = choose(shadow::occlude_calls(), calls.shadow, [&](auto c) { return shadow(c); });
    stores_ = choose(std::vector<Stores>{Stores::kThroughCaches, Stores::kAroundCaches},
                     calls.stream, [&](Stores s) { return stream(filter_, s, "stream"); });
    // The first time is the first touch of the memory.
    static_cast<void>(measure_once());
    const Measured once = measure_once();
    setup_.rounds = rounds_for(once.setup.wall_milliseconds);
    deposit_.rounds = rounds_for(once.deposit.wall_milliseconds);
    noise_.rounds = rounds_for(once.noise.wall_milliseconds);
    filter_.rounds = rounds_for(once.filter.wall_milliseconds);
    shade_.rounds = rounds_for(once.shade.wall_milliseconds);
    rays_.rounds = rounds_for(once.rays.wall_milliseconds);
}

LoopTime Limits::primary(shadow::RayCall call) {
    return timed(profile_, kPrimaryRaysPhase, 1, [&] {
        arena_.for_each(
            static_cast<int>(work_.primary.size()),
            [&](int index, int) {
                bare_.intersect(work_.primary[static_cast<std::size_t>(index)], call);
            },
            cancelled_);
    });
}

LoopTime Limits::shadow(shadow::RayCall call) {
    const LoopTime kept = timed(profile_, kShadowRaysPhase, 1, [&] {
        arena_.for_each(
            static_cast<int>(work_.shadow.size()),
            [&](int index, int worker) {
                bare_.occlude(work_.shadow[static_cast<std::size_t>(index)], call,
                              scratch_[static_cast<std::size_t>(worker)]);
            },
            cancelled_);
    });
    return scaled(kept, work_.shadow_scale);
}

LoopTime Limits::stream(Stream& loop, StreamStores stores, const char* name) {
    if (is_cancelled()) return {};
    return timed(profile_, name, loop.rounds, [&] { loop.triad.run(arena_, stores); });
}

LoopTime Limits::arithmetic(const Arithmetic& loop, const char* name) {
    if (is_cancelled()) return {};
    return timed(profile_, name, loop.rounds,
                 [&] { multiply_adds(loop.multiply_adds, isa_, arena_); });
}

Limits::Measured Limits::floors(const Floors& tasks) const {
    const auto rays = [&](const char* name, double scale) {
        const double milliseconds = scale * tasks.milliseconds(profile::Kind::kTask, name);
        return LoopTime{milliseconds / arena_.threads(), milliseconds};
    };
    PENUMBRA_ASSERT(least_, "nothing was measured");
    Measured floors = *least_;
    floors.primary_rays = rays(kPrimaryRaysPhase, 1);
    floors.shadow_rays = rays(kShadowRaysPhase, work_.shadow_scale);
    return floors;
}

Limits::Measured Limits::measure() {
    const Measured measured = measure_once();
    if (!least_) least_ = measured;
    for (const auto loop : {&Measured::shade, &Measured::rays, &Measured::setup, &Measured::deposit,
                            &Measured::noise, &Measured::filter}) {
        const LoopTime& time = measured.*loop;
        LoopTime& least = (*least_).*loop;
        least = {std::min(least.wall_milliseconds, time.wall_milliseconds),
                 std::min(least.thread_milliseconds, time.thread_milliseconds)};
    }
    return measured;
}

Limits::Measured Limits::measure_once() {
    return {.primary_rays = primary(primary_call_),
            .shadow_rays = shadow(shadow_call_),
            .shade = arithmetic(shade_, "limit: arithmetic of shade"),
            .rays = arithmetic(rays_, "limit: arithmetic of rays"),
            .setup = stream(setup_, stores_, "limit: stream of setup"),
            .deposit = stream(deposit_, stores_, "limit: stream of deposit"),
            .noise = stream(noise_, stores_, "limit: stream of noise"),
            .filter = stream(filter_, stores_, "limit: stream of filter")};
}

std::string Limits::stream_call() const {
    return text(stores_);
}

}  // namespace penumbra::bench
