#include "apps/bench/passes.h"

#include <algorithm>
#include <map>

#include "core/profile/timeline.h"

namespace penumbra::bench {
namespace {

using renderer::Pass;

std::string text(Pass pass) {
    return std::string(renderer::name(pass));
}

PassResult frame_pass(Pass pass, profile::Work work, LimitKind limit) {
    return {.name = text(pass),
            .is_tile_pass = renderer::is_tile_pass(pass),
            .work = work,
            .limit = limit};
}

std::vector<PassResult> passes(const Workload& work) {
    const Demands least = demands(work);
    const std::uint64_t pixels = work.pixels;
    return {
        frame_pass(Pass::kEvaluate, {.triangles = work.triangles}, LimitKind::kNone),
        frame_pass(Pass::kSetup, {.triangles = work.triangles, .bytes = least.setup_bytes},
                   LimitKind::kStream),
        frame_pass(Pass::kRasterize, {.pixels = pixels, .triangles = work.triangles},
                   LimitKind::kPrimaryRays),
        frame_pass(Pass::kResolve, {.pixels = pixels}, LimitKind::kPrimaryRays),
        frame_pass(Pass::kShade, {.pixels = pixels}, LimitKind::kArithmetic),
        frame_pass(Pass::kRays, {.pixels = pixels, .rays = work.shadow_rays},
                   LimitKind::kArithmetic),
        frame_pass(Pass::kTrace, {.rays = work.shadow_rays}, LimitKind::kShadowRays),
        frame_pass(Pass::kDeposit, {.pixels = pixels, .bytes = least.deposit_bytes},
                   LimitKind::kStream),
        frame_pass(Pass::kNoise, {.pixels = pixels, .bytes = least.noise_bytes},
                   LimitKind::kStream),
        frame_pass(Pass::kFilter, {.pixels = pixels, .bytes = least.filter_bytes},
                   LimitKind::kStream),
    };
}

std::vector<PassResult> groups(const Workload& work) {
    const Demands least = demands(work);
    const profile::Work seen = {.pixels = work.pixels, .triangles = work.triangles};
    return {
        {.name = "other"},
        {.name = "visibility",
         .parts = {text(Pass::kSetup), text(Pass::kRasterize), text(Pass::kResolve)},
         .work = seen,
         .limit = LimitKind::kPrimaryRays},
        {.name = "shadow",
         .parts = {text(Pass::kShade), text(Pass::kRays), text(Pass::kTrace)},
         .work = {.pixels = work.pixels, .rays = work.shadow_rays},
         .limit = LimitKind::kShadowRays},
        {.name = "denoise",
         .parts = {text(Pass::kNoise), text(Pass::kFilter)},
         .work = {.pixels = work.pixels, .bytes = least.noise_bytes + least.filter_bytes},
         .limit = LimitKind::kStream},
        {.name = "frame",
         .work = {.pixels = work.pixels, .triangles = work.triangles, .rays = work.shadow_rays},
         .limit = LimitKind::kSum},
    };
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

double limit_of(const std::string& pass, const Limits::Measured& m, int threads) {
    const auto tiles = [&](const LoopTime& time) { return cost(time, true, threads); };
    const auto whole = [&](const LoopTime& time) { return cost(time, false, threads); };
    if (pass == text(Pass::kSetup)) return whole(m.setup);
    if (pass == text(Pass::kRasterize) || pass == text(Pass::kResolve) || pass == "visibility")
        return tiles(m.primary_rays);
    if (pass == text(Pass::kShade)) return tiles(m.shade);
    if (pass == text(Pass::kRays)) return tiles(m.rays);
    if (pass == text(Pass::kTrace) || pass == "shadow") return tiles(m.shadow_rays);
    if (pass == text(Pass::kDeposit)) return tiles(m.deposit);
    if (pass == text(Pass::kNoise)) return whole(m.noise);
    if (pass == text(Pass::kFilter)) return whole(m.filter);
    if (pass == "denoise") return whole(m.noise) + whole(m.filter);
    if (pass == "frame")
        return tiles(m.primary_rays) + tiles(m.shade) + tiles(m.rays) + tiles(m.shadow_rays) +
               tiles(m.deposit) + whole(m.noise) + whole(m.filter);
    return 0;
}

LoopTime time_of(Pass pass, const renderer::FrameStatistics& frame, const profile::Profile& profile,
                 int threads) {
    const double milliseconds = 1e3 * frame.passes[pass];
    if (renderer::is_tile_pass(pass)) return {milliseconds / threads, milliseconds};
    // Outside of its loops one thread works alone.
    const std::string_view name = renderer::name(pass);
    const double loops = 1e-6 * static_cast<double>(total(profile, profile::Kind::kLoop, name));
    const double tasks = 1e-6 * static_cast<double>(total(profile, profile::Kind::kTask, name));
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
    for (int i = 0; i < renderer::kPassCount; ++i) names.push_back(text(static_cast<Pass>(i)));
    return names;
}

// What the pass's least times make together, in milliseconds of the wall clock.
double floor_of(Pass pass, const Floors& floors, int threads) {
    const std::string_view name = renderer::name(pass);
    if (renderer::is_tile_pass(pass))
        return floors.milliseconds(profile::Kind::kPass, name) / threads;
    return floors.milliseconds(profile::Kind::kPhase, name) +
           floors.milliseconds(profile::Kind::kTask, name) / threads;
}

}  // namespace

void set_floors(const Floors& floors, const Limits::Measured& limits, ThreadRun& run) {
    std::map<std::string, double> of_pass;
    for (int i = 0; i < renderer::kPassCount; ++i) {
        const auto pass = static_cast<Pass>(i);
        if (pass == Pass::kEvaluate) continue;  // builds what later repetitions find built
        of_pass[text(pass)] = floor_of(pass, floors, run.threads);
        of_pass["frame"] += of_pass[text(pass)];
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
    for (PassResult& group : groups(work)) run.passes.push_back(std::move(group));
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
        add(run.passes[i], time_of(static_cast<Pass>(i), frame, profile, run.threads));
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
