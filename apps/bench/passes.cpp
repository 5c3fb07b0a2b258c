#include "apps/bench/passes.h"

#include <algorithm>
#include <map>

#include "core/profile/timeline.h"

namespace penumbra::bench {
namespace {

using renderer::PassGroup;
using renderer::PassGroupInfo;
using renderer::PassInfo;
using renderer::PassScope;

bool is_tile_pass(const PassInfo& pass) {
    return pass.scope == PassScope::kTile;
}

profile::Work work_of(const PassInfo& pass, const Workload& work) {
    return {.pixels = pass.work.pixels ? work.pixels : 0,
            .triangles = pass.work.triangles ? work.triangles : 0,
            .rays = pass.work.rays ? work.shadow_rays : 0,
            .bytes = pass.limit == LimitKind::kStream ? demand(pass, work) : 0};
}

// What passes work on is the same for all of them; what they move adds up.
profile::Work together(const profile::Work& a, const profile::Work& b) {
    return {.pixels = std::max(a.pixels, b.pixels),
            .triangles = std::max(a.triangles, b.triangles),
            .rays = std::max(a.rays, b.rays),
            .bytes = a.bytes + b.bytes};
}

PassResult group_of(const PassGroupInfo& group, const Workload& work) {
    PassResult result{.name = std::string(group.name), .limit = group.limit};
    for (const PassInfo& pass : renderer::kPasses) {
        if (pass.group != group.group) continue;
        result.parts.emplace_back(pass.name);
        result.work = together(result.work, work_of(pass, work));
    }
    if (group.limit != LimitKind::kStream) result.work.bytes = 0;
    return result;
}

std::vector<PassResult> passes(const Workload& work) {
    std::vector<PassResult> results;
    profile::Work all;
    for (const PassInfo& pass : renderer::kPasses) {
        results.push_back({.name = std::string(pass.name),
                           .is_tile_pass = is_tile_pass(pass),
                           .work = work_of(pass, work),
                           .limit = pass.limit});
        all = together(all, results.back().work);
    }
    all.bytes = 0;
    results.push_back({.name = "other"});
    for (const PassGroupInfo& group : renderer::kPassGroups)
        results.push_back(group_of(group, work));
    results.push_back({.name = "frame", .work = all, .limit = LimitKind::kSum});
    return results;
}

std::string call(LimitKind kind, const Limits& limits) {
    switch (kind) {
        case LimitKind::kPrimaryRays:
            return limits.primary_call();
        case LimitKind::kShadowRays:
            return limits.shadow_call();
        case LimitKind::kStream:
            return limits.stream_call();
        case LimitKind::kArithmetic:
            return limits.arithmetic_call();
        case LimitKind::kNone:
        case LimitKind::kSum:
            break;
    }
    return "";
}

// What a loop costs a frame: of loops that run in between those of other passes their share.
double cost(const LoopTime& time, bool is_tile_pass, int threads) {
    return is_tile_pass ? time.thread_milliseconds / threads : time.wall_milliseconds;
}

double limit_of(const PassInfo& pass, const Limits::Measured& m, int threads) {
    return cost(m.of(pass), is_tile_pass(pass), threads);
}

double limit_of(const PassGroupInfo& group, const Limits::Measured& m, int threads) {
    if (group.limit == LimitKind::kPrimaryRays) return cost(m.primary_rays, true, threads);
    if (group.limit == LimitKind::kShadowRays) return cost(m.shadow_rays, true, threads);
    double sum = 0;
    for (const PassInfo& pass : renderer::kPasses)
        if (pass.group == group.group) sum += limit_of(pass, m, threads);
    return sum;
}

// Bare rays once each; they need no set-up of triangles, so that primary rays stand for all of
// visibility.
double limit_of_frame(const Limits::Measured& m, int threads) {
    double sum = cost(m.primary_rays, true, threads);
    for (const PassInfo& pass : renderer::kPasses)
        if (pass.group != PassGroup::kVisibility) sum += limit_of(pass, m, threads);
    return sum;
}

double limit_of(const std::string& name, const Limits::Measured& m, int threads) {
    for (const PassInfo& pass : renderer::kPasses)
        if (name == pass.name) return limit_of(pass, m, threads);
    for (const PassGroupInfo& group : renderer::kPassGroups)
        if (name == group.name) return limit_of(group, m, threads);
    return name == "frame" ? limit_of_frame(m, threads) : 0;
}

LoopTime time_of(const PassInfo& pass, const renderer::FrameStatistics& frame,
                 const profile::Profile& profile, int threads) {
    const double milliseconds = 1e3 * frame.passes[pass.pass];
    if (is_tile_pass(pass)) return {milliseconds / threads, milliseconds};
    // Outside of its loops one thread works alone.
    const double loops =
        1e-6 * static_cast<double>(total(profile, profile::Kind::kLoop, pass.name));
    const double tasks =
        1e-6 * static_cast<double>(total(profile, profile::Kind::kTask, pass.name));
    return {milliseconds, milliseconds - loops + tasks};
}

// The passes' times come first in a run, so that groups can add them up.
LoopTime sum_of(const std::vector<std::string>& parts, const ThreadRun& run) {
    LoopTime sum;
    for (const std::string& part : parts) {
        const Sample& sample = find(run, part)->samples.back();
        sum.wall_milliseconds += sample.milliseconds;
        sum.thread_milliseconds += sample.thread_milliseconds;
    }
    return sum;
}

std::vector<std::string> all_passes() {
    std::vector<std::string> names;
    for (const PassInfo& pass : renderer::kPasses) names.emplace_back(pass.name);
    return names;
}

// What the pass's least times make together, in milliseconds of the wall clock.
double floor_of(const PassInfo& pass, const Floors& floors, int threads) {
    if (is_tile_pass(pass)) return floors.milliseconds(profile::Kind::kPass, pass.name) / threads;
    return floors.milliseconds(profile::Kind::kPhase, pass.name) +
           floors.milliseconds(profile::Kind::kTask, pass.name) / threads;
}

}  // namespace

void set_floors(const Floors& floors, const Limits::Measured& limits, ThreadRun& run) {
    std::map<std::string, double> of_pass;
    for (const PassInfo& pass : renderer::kPasses) {
        if (pass.pass == renderer::Pass::kEvaluate) continue;  // builds what later ones find built
        const double floor = floor_of(pass, floors, run.threads);
        of_pass[std::string(pass.name)] = floor;
        of_pass["frame"] += floor;
    }
    for (PassResult& pass : run.passes) {
        double floor = of_pass[pass.name];
        for (const std::string& part : pass.parts) floor += of_pass[part];
        for (Sample& sample : pass.samples) {
            sample.floor_milliseconds = floor;
            sample.limit_floor_milliseconds = limit_of(pass.name, limits, run.threads);
        }
    }
}

ThreadRun empty_run(int threads, const Workload& work, const Limits& limits) {
    ThreadRun run{.threads = threads, .passes = passes(work)};
    for (PassResult& pass : run.passes) pass.limit_call = call(pass.limit, limits);
    return run;
}

void add_samples(const renderer::FrameStatistics& frame, const profile::Profile& profile,
                 const Limits::Measured& limits, double core_share, ThreadRun& run) {
    const auto add = [&](PassResult& pass, const LoopTime& time) {
        pass.samples.push_back({.milliseconds = time.wall_milliseconds,
                                .thread_milliseconds = time.thread_milliseconds,
                                .limit_milliseconds = limit_of(pass.name, limits, run.threads),
                                .core_share = core_share});
    };
    for (std::size_t i = 0; i < renderer::kPassCount; ++i)
        add(run.passes[i], time_of(renderer::kPasses[i], frame, profile, run.threads));
    const LoopTime parts = sum_of(all_passes(), run);
    const double whole = 1e3 * frame.render_seconds;
    // Waiting for the last tiles, and what stands between the passes.
    const double other = std::max(whole - parts.wall_milliseconds, 0.0);
    for (std::size_t i = renderer::kPassCount; i < run.passes.size(); ++i) {
        PassResult& group = run.passes[i];
        if (group.name == "other")
            add(group, {.wall_milliseconds = other});
        else if (group.name == "frame")
            add(group, {whole, parts.thread_milliseconds});
        else
            add(group, sum_of(group.parts, run));
    }
}

}  // namespace penumbra::bench
