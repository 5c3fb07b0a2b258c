#include "apps/bench/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "apps/bench/core_share.h"
#include "apps/bench/hardware_counters.h"
#include "apps/bench/limits.h"
#include "apps/bench/machine.h"
#include "apps/bench/passes.h"
#include "apps/bench/patience.h"
#include "apps/bench/undisturbed.h"
#include "apps/renderer/builtin_scene.h"
#include "apps/renderer/renderer.h"
#include "core/profile/timeline.h"
#include "core/scene/read_scene.h"

namespace penumbra::bench {
namespace {

// The file's name without its ending, with a number where it was there before.
std::string unique_name(const std::string& path, const std::vector<SceneResult>& others) {
    const std::string stem =
        path.empty() ? "built-in" : std::filesystem::path(path).stem().string();
    std::string name = stem;
    const auto is_taken = [&] {
        return std::any_of(others.begin(), others.end(),
                           [&](const SceneResult& other) { return other.name == name; });
    };
    for (int number = 2; is_taken(); ++number) name = fmt::format("{}-{}", stem, number);
    return name;
}

// Appends a run's slices to the recording, at its end, within one slice of the run's name.
void append(const profile::Profile& run, const std::string& name, Recording& recording) {
    const std::vector<profile::Timeline> slices = timelines(run);
    if (slices.empty()) return;
    recording.names.push_back(name);
    const std::vector<profile::Timeline> before = timelines(recording.profile);
    const profile::Nanoseconds begin = before.empty() ? 0 : before.front().end;
    const profile::Nanoseconds shift = begin - slices.front().begin;
    recording.profile.make_tracks(run.threads());
    for (int worker = 0; worker < run.threads(); ++worker)
        for (profile::Slice slice : run.track(worker).slices()) {
            slice.begin += shift;
            slice.end += shift;
            recording.profile.track(worker).add(slice);
        }
    recording.profile.track(0).add({.name = recording.names.back().c_str(),
                                    .begin = begin,
                                    .end = slices.front().end + shift,
                                    .first = {"threads", run.threads()}});
}

// What the repetitions of one run work with.
struct Stage {
    profile::Profile& profile;
    renderer::Renderer& renderer;
    const parallel::Arena& arena;  // of the limits; the profile records it
    Limits& limits;
    ThreadRun run;
    Floors floors;
};

double look_at_cores(const Stage& stage) {
    const profile::Phase phase(&stage.profile, "core share");
    return core_share(stage.arena);
}

// One scene, run after run.
class SceneBench {
  public:
    SceneBench(const BenchSettings& settings, const std::string& path, const Machine& machine,
               const CounterSet& counters, const Listener& listener,
               const std::atomic<bool>& cancelled)
        : settings_(settings),
          machine_(machine),
          counters_(counters),
          listener_(listener),
          cancelled_(cancelled),
          scene_(path.empty() ? renderer::read_builtin_scene() : read_scene(path)),
          frame_(settings.frame > 0 ? settings.frame : scene_.animation.first_frame) {
        result_.path = path;
        renderer::check_settings(scene_, settings.image, settings.execution);
    }

    void run(const std::string& name, Recording* recording) {
        result_.name = name;
        for (const int threads : settings_.threads) {
            if (cancelled_) return;
            run_threads(threads, recording);
        }
    }

    [[nodiscard]] SceneResult take() { return std::move(result_); }

  private:
    void run_threads(int threads, Recording* recording) {
        profile::Profile profile;
        renderer::ExecutionSettings execution = settings_.execution;
        execution.threads = threads;
        execution.profile = &profile;
        renderer::Renderer renderer(scene_, settings_.image, execution);
        tell(threads, "warming up");
        for (int i = 0; i < settings_.warmups && !cancelled_; ++i) render(renderer);
        // The frames' memory, before that of the limits is added to it.
        if (result_.runs.empty()) result_.peak_memory_bytes = peak_memory_bytes();

        parallel::Arena arena(threads);
        prepare_limits(arena);
        if (cancelled_) return;
        arena.record(&profile);
        const LimitSettings limit_settings{.isa = execution.isa.value_or(simd::best_isa()),
                                           .calls = known_calls(threads),
                                           .cancelled = &cancelled_};
        tell(threads, "looking for the quickest calls");
        Limits limits(*workload_, *bare_, limit_settings, arena, profile);
        Stage stage{profile, renderer, arena, limits, empty_run(threads, *workload_, limits), {}};
        Patience patience({.repetitions = settings_.repetitions,
                           .seconds = settings_.patience_seconds,
                           .best_share = known_share(threads)},
                          arena);
        while (patience.wants_more()) {
            tell(threads, patience.progress());
            patience.wait(cancelled_);
            if (cancelled_) return;
            profile.clear();
            patience.add(repeat(patience.count(), stage));
            if (cancelled_) return;
        }
        set_floors(stage.floors, limits.floors(stage.floors), stage.run);
        if (stage.run.counters) divide(patience.count(), *stage.run.counters);
        if (recording) append(profile, run_name(threads), *recording);
        result_.runs.push_back(
            least_disturbed(stage.run, static_cast<std::size_t>(settings_.repetitions)));
    }

    // The calls of the first report that has this run.
    [[nodiscard]] LimitCalls known_calls(int threads) const {
        for (const Report* const report : settings_.calls_of) {
            LimitCalls calls = limit_calls(*report, result_.name, threads);
            if (!calls.primary.empty()) return calls;
        }
        return {};
    }

    // What cores gave when they were our own, as far as older reports of this processor know.
    [[nodiscard]] double known_share(int threads) const {
        double best = 0;
        for (const Report* const report : settings_.calls_of)
            if (report->machine.processor == machine_.processor)
                best = std::max(best, best_core_share(*report, result_.name, threads));
        return best;
    }

    // The frame and its limits in turns, so that whatever slows the machine down meets both.
    // Returns what its cores gave it.
    double repeat(int index, Stage& stage) {
        Limits::Measured measured;
        if (index % 2 == 1) measured = stage.limits.measure();
        const double share_before = look_at_cores(stage);
        const std::optional<HardwareCounters> before = counters_.read();
        const renderer::FrameStatistics statistics = render(stage.renderer);
        const std::optional<HardwareCounters> after = counters_.read();
        const double share = std::min(share_before, look_at_cores(stage));
        if (index % 2 == 0) measured = stage.limits.measure();
        add_samples(statistics, stage.profile, measured, share, stage.run);
        stage.floors.add(stage.profile);
        if (before && after) add(*before, *after, stage.run.counters);
        return share;
    }

    static void add(const HardwareCounters& before, const HardwareCounters& after,
                    std::optional<HardwareCounters>& sum) {
        if (!sum) sum.emplace();
        sum->cycles += after.cycles - before.cycles;
        sum->instructions += after.instructions - before.instructions;
        sum->cache_misses += after.cache_misses - before.cache_misses;
    }

    static void divide(int repetitions, HardwareCounters& sum) {
        const auto count = static_cast<std::uint64_t>(repetitions);
        sum.cycles /= count;
        sum.instructions /= count;
        sum.cache_misses /= count;
    }

    renderer::FrameStatistics render(renderer::Renderer& renderer) {
        return renderer.render(frame_, {renderer::Aov::kBeauty}, film_, &cancelled_);
    }

    void prepare_limits(const parallel::Arena& arena) {
        if (workload_) return;
        workload_ = std::make_unique<Workload>(record_workload(
            scene_, settings_.image, settings_.execution, frame_, kMemoryOfRays, &cancelled_));
        if (cancelled_) return;
        bare_ = std::make_unique<shadow::BareRays>(workload_->view, settings_.execution.trace_isa,
                                                   arena);
        const renderer::ImageSettings image = renderer::completed(scene_, settings_.image);
        result_.frame = frame_;
        result_.width = image.width;
        result_.height = image.height;
        result_.samples_per_pixel = image.samples_per_pixel;
        result_.triangles = workload_->triangles;
        result_.lights = workload_->view.lights.size();
        result_.shadow_rays = workload_->shadow_rays;
        result_.covered_pixels = workload_->covered_pixels;
    }

    [[nodiscard]] std::string run_name(int threads) const {
        return fmt::format("{}, {} thread{}", result_.name, threads, threads == 1 ? "" : "s");
    }

    void tell(int threads, const std::string& what) const {
        if (listener_) listener_(run_name(threads) + ": " + what);
    }

    const BenchSettings& settings_;
    const Machine& machine_;
    const CounterSet& counters_;
    const Listener& listener_;
    const std::atomic<bool>& cancelled_;
    Scene scene_;
    int frame_;
    renderer::Film film_;
    std::unique_ptr<Workload> workload_;
    std::unique_ptr<shadow::BareRays> bare_;
    SceneResult result_;
};

}  // namespace

Report measure(const BenchSettings& settings, const Listener& listener,
               const std::atomic<bool>& cancelled, Recording* recording) {
    Report report{
        .machine = describe_machine(settings.execution.isa.value_or(simd::best_isa()),
                                    settings.execution.trace_isa),
        .warmups = settings.warmups,
        .repetitions = settings.repetitions,
    };
    // Before any thread of ours runs: those that come later inherit the counters.
    const CounterSet counters;
    report.machine.counters = counters.state();
    for (const std::string& path : settings.scenes) {
        if (cancelled) break;
        reset_peak_memory();
        SceneBench bench(settings, path, report.machine, counters, listener, cancelled);
        bench.run(unique_name(path, report.scenes), recording);
        report.scenes.push_back(bench.take());
    }
    return report;
}

}  // namespace penumbra::bench
