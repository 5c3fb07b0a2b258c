#include "apps/cli/bench_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/bench/machine.h"
#include "apps/cli/option_checks.h"
#include "apps/renderer/settings_table.h"
#include "core/error.h"
#include "core/parallel/arena.h"

namespace penumbra::cli {
namespace {

constexpr int kMostThreads = 1024;

// Groups of options that say what is measured, and how.
constexpr const char* kWhatGroup = "What is measured";
constexpr const char* kHowGroup = "How often, and on how many threads";
constexpr const char* kRunningGroup = "Running";

renderer::Choice<std::optional<simd::Isa>> bench_isa() {
    return isa_setting("Instruction set of everything but the ray tracer");
}

// Settings of which some are options here.
template <class V>
void each_setting_of(BenchOptions& o, const V& visit) {
    renderer::each_frame_setting(o.image, visit);
    renderer::each_light_setting(o.image, visit);
    renderer::each_tracer_setting(o.image, o.execution, visit);
}

// A setting that `penumbra render` has too, explained for this command.
void declare_setting(CLI::App& command, BenchOptions& o, std::string_view name,
                     std::string_view help) {
    each_setting_of(o, [&](auto setting, auto& value) {
        if (setting.name != name) return;
        setting.help = help;
        SettingDeclarer(command, o.texts)(setting, value);
    });
}

void declare_what(CLI::App& command, BenchOptions& o) {
    command
        .add_option("SCENES", o.scenes,
                    "Scene files (.json) or models (.obj); without any the built-in scene")
        ->type_name("FILE.json|obj");
    command.option_defaults()->group(kWhatGroup);
    command.add_option("--frame", o.frame, "Which frame of each scene [its first one]")
        ->check(in_range(1, 1e9));
    declare_setting(command, o, "size", "Size of the picture in pixels [the scene's]");
    declare_setting(command, o, "spp", "Shadow rays per light and pixel [the scene's, else 1]");
}

void declare_how(CLI::App& command, BenchOptions& o) {
    command.option_defaults()->group(kHowGroup);
    command
        .add_option("--threads", o.threads,
                    "Numbers of threads to sweep over, a list with commas [powers of two up to "
                    "what affinity, cgroup quota and Slurm allow, and that]")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(in_range(1, kMostThreads));
    command.add_option("--warmup", o.warmups, "Frames before the first measured one")
        ->check(in_range(0, 1000))
        ->capture_default_str();
    command.add_option("--repetitions", o.repetitions, "Measured frames per number of threads")
        ->check(in_range(1, 100000))
        ->capture_default_str();
    command
        .add_option("--patience", o.patience,
                    "Seconds that each launch may spend, per scene and number of threads, to wait "
                    "for processors that nobody else uses, and to repeat what was disturbed")
        ->type_name("SECONDS")
        ->check(in_range(0, 86400))
        ->capture_default_str();
    command
        .add_option("--launches", o.launches,
                    "Start the program that often, one after the other, and measure in each [1; "
                    "with --compare as often as the old report]")
        ->check(in_range(1, 1000));
    command
        .add_option("--calls-of", o.calls_of,
                    "Measure limits with the calls of this report, instead of looking for the "
                    "quickest, and learn from it what cores of our own give; of several the "
                    "first one that has them, and the best [with --compare the old report]")
        ->type_name("FILE.json")
        ->allow_extra_args(false);
}

void declare_comparison(CLI::App& command, BenchOptions& o) {
    command.option_defaults()->group("Comparison");
    command
        .add_option("--compare", o.compare,
                    "Say what got slower since this report, which --json wrote, with confidence; "
                    "both need at least 5 launches")
        ->type_name("OLD.json");
    command
        .add_option("--fail-slower", o.fail_slower,
                    "Exit with 1 if a pass is slower by more than so many percent, and certainly "
                    "slower")
        ->type_name("PERCENT")
        ->check(in_range(0, 1e6));
    command
        .add_option("--from", o.from,
                    "Measure nothing: take this report, which --json wrote, for the new one")
        ->type_name("FILE.json");
}

void declare_output(CLI::App& command, BenchOptions& o) {
    command.option_defaults()->group("Reports, beside the table");
    command.add_option("--json", o.json, "Write every repetition, in Google Benchmark's format")
        ->type_name("FILE.json");
    command.add_option("--csv", o.csv, "Write medians and quartiles")->type_name("FILE.csv");
    command
        .add_option("--trace", o.trace,
                    "Write what each thread did in the last repetitions, for ui.perfetto.dev or "
                    "chrome://tracing")
        ->type_name("FILE.json");
    command
        .add_option("--html", o.html,
                    "Write a page that needs nothing but itself: how the passes scale, and bars "
                    "against the limits")
        ->type_name("FILE.html");
}

void declare_execution(CLI::App& command, BenchOptions& o) {
    command.option_defaults()->group(kRunningGroup);
    SettingDeclarer(command, o.texts)(bench_isa(), o.execution.isa);
    declare_setting(command, o, "trace-isa",
                    "Instruction set of the ray tracer, in the frames and in their limits");
}

}  // namespace

void refuse_unheard(const CLI::App& command, const BenchOptions& options) {
    if (options.fail_slower && options.compare.empty())
        throw InputError("--fail-slower: needs --compare");
    if (options.from.empty()) return;
    if (!options.scenes.empty())
        throw InputError("--from: measures nothing, so it takes no scenes");
    if (!options.trace.empty())
        throw InputError("--trace: there is none of a report that was written");
    for (const CLI::Option* option : command.get_options()) {
        const bool is_of_measuring = option->get_group() == kWhatGroup ||
                                     option->get_group() == kHowGroup ||
                                     option->get_group() == kRunningGroup;
        if (is_of_measuring && option->count() > 0)
            throw InputError(option->get_name() + ": --from measures nothing");
    }
}

void declare_options(CLI::App& command, BenchOptions& options) {
    declare_what(command, options);
    declare_how(command, options);
    declare_comparison(command, options);
    declare_output(command, options);
    declare_execution(command, options);
}

bench::BenchSettings interpret(const BenchOptions& options) {
    BenchOptions o = options;
    const SettingReader read(o.texts);
    each_setting_of(o, read);
    read(bench_isa(), o.execution.isa);
    bench::BenchSettings settings{.scenes = o.scenes,
                                  .frame = o.frame,
                                  .image = o.image,
                                  .execution = o.execution,
                                  .threads = o.threads,
                                  .warmups = o.warmups,
                                  .repetitions = o.repetitions,
                                  .patience_seconds = o.patience};
    if (settings.scenes.empty()) settings.scenes.emplace_back();
    // Refuses what this processor does not have.
    static_cast<void>(shadow::parse_trace_isa(shadow::name(o.execution.trace_isa)));
    if (settings.threads.empty())
        settings.threads = bench::thread_sweep(parallel::default_thread_count());
    // Each number once, the fewest first: what speed-ups refer to.
    std::sort(settings.threads.begin(), settings.threads.end());
    settings.threads.erase(std::unique(settings.threads.begin(), settings.threads.end()),
                           settings.threads.end());
    return settings;
}

}  // namespace penumbra::cli
