#include "apps/bench/limits.h"

#include <fmt/format.h>

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

// "limit: stream of setup". Slices keep the address of their name.
const char* phase_name(renderer::Pass pass) {
    static const std::vector<std::string> kNames = [] {
        std::vector<std::string> names;
        for (const renderer::PassInfo& info : renderer::kPasses)
            names.push_back(fmt::format("limit: {} of {}", name(info.limit), info.name));
        return names;
    }();
    return kNames[static_cast<std::size_t>(pass)].c_str();
}

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

std::uint64_t demand(const renderer::PassInfo& pass, const Workload& work) {
    const renderer::LeastWork& least = pass.least;
    return least.per_pixel * work.pixels + least.per_vertex * work.vertices +
           least.per_triangle * work.triangles + least.per_ray * work.shadow_rays +
           least.per_shaded_pair * work.shaded_pairs +
           least.per_shaded_vertex * work.shaded_vertices;
}

const LoopTime& Limits::Measured::of(const renderer::PassInfo& pass) const {
    if (pass.limit == LimitKind::kPrimaryRays) return primary_rays;
    if (pass.limit == LimitKind::kShadowRays) return shadow_rays;
    return own[static_cast<std::size_t>(pass.pass)];
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
      scratch_(static_cast<std::size_t>(arena.threads())) {
    make_loops(LimitKind::kArithmetic);
    make_loops(LimitKind::kStream);
    using Stores = StreamStores;
    const LimitCalls& calls = settings.calls;
    primary_call_ =
        choose(shadow::intersect_calls(), calls.primary, [&](auto c) { return primary(c); });
    shadow_call_ = choose(shadow::occlude_calls(), calls.shadow, [&](auto c) { return shadow(c); });
    Loop& longest = loop_of(renderer::Pass::kFilter);
    stores_ = choose(std::vector<Stores>{Stores::kThroughCaches, Stores::kAroundCaches},
                     calls.stream, [&](Stores s) { return stream(longest, s, "stream"); });
    // The first time is the first touch of the memory.
    static_cast<void>(measure_once());
    const Measured once = measure_once();
    for (Loop& loop : loops_) loop.rounds = rounds_for(once.of(*loop.pass).wall_milliseconds);
}

void Limits::make_loops(LimitKind kind) {
    for (const renderer::PassInfo& pass : renderer::kPasses) {
        if (pass.limit != kind) continue;
        const std::uint64_t least = demand(pass, work_);
        loops_.push_back(kind == LimitKind::kStream ? Loop{&pass, 0, std::make_unique<Triad>(least)}
                                                    : Loop{&pass, least, nullptr});
    }
}

Limits::Loop& Limits::loop_of(renderer::Pass pass) {
    const auto found = std::ranges::find(loops_, &renderer::info(pass), &Loop::pass);
    PENUMBRA_ASSERT(found != loops_.end(), "no loop for {}", renderer::name(pass));
    return *found;
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

LoopTime Limits::stream(Loop& loop, StreamStores stores, const char* name) {
    if (is_cancelled()) return {};
    return timed(profile_, name, loop.rounds, [&] { loop.triad->run(arena_, stores); });
}

LoopTime Limits::run(Loop& loop) {
    const char* const name = phase_name(loop.pass->pass);
    if (loop.triad) return stream(loop, stores_, name);
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
    for (std::size_t i = 0; i < measured.own.size(); ++i) {
        const LoopTime& time = measured.own[i];
        LoopTime& least = least_->own[i];
        least = {std::min(least.wall_milliseconds, time.wall_milliseconds),
                 std::min(least.thread_milliseconds, time.thread_milliseconds)};
    }
    return measured;
}

Limits::Measured Limits::measure_once() {
    Measured measured{.primary_rays = primary(primary_call_), .shadow_rays = shadow(shadow_call_)};
    for (Loop& loop : loops_) measured.own[static_cast<std::size_t>(loop.pass->pass)] = run(loop);
    return measured;
}

std::string Limits::stream_call() const {
    return text(stores_);
}

}  // namespace penumbra::bench
