#include "apps/cli/bench_command.h"
#include "apps/bench/report_writer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "apps/bench/csv.h"
#include "apps/bench/html_page.h"
#include "apps/bench/report_reader.h"
#include "apps/bench/table.h"
#include "apps/cli/bench_compare.h"
#include "apps/cli/bench_launches.h"
#include "apps/cli/bench_options.h"
#include "apps/cli/option_checks.h"
#include "apps/cli/say.h"
#include "apps/cli/signals.h"
#include "core/error.h"
#include "core/image/publish.h"
#include "core/profile/trace.h"

namespace penumbra::cli {
namespace {

constexpr const char* kBenchFooter =
    "The columns are explained in docs/bench.md.\n\n"
    "Examples:\n"
    "  penumbra bench\n"
    "  penumbra bench shot.json room.json --threads 1,8,64 --json bench.json\n"
    "  penumbra bench shot.json --size 1280x720 --trace trace.json\n"
    "  penumbra bench shot.json --launches 15 --json old.json\n"
    "  penumbra bench shot.json --compare old.json --fail-slower 3";

void require_files_of_their_own(const BenchOptions& options) {
    std::vector<PlannedFile> outputs;
    if (!options.json.empty()) outputs.emplace_back("--json", options.json);
    if (!options.csv.empty()) outputs.emplace_back("--csv", options.csv);
    if (!options.trace.empty()) outputs.emplace_back("--trace", options.trace);
    if (!options.html.empty()) outputs.emplace_back("--html", options.html);
    std::vector<std::filesystem::path> inputs{options.scenes.begin(), options.scenes.end()};
    for (const std::string& report : {options.compare, options.from})
        if (!report.empty()) inputs.emplace_back(report);
    inputs.insert(inputs.end(), options.calls_of.begin(), options.calls_of.end());
    require_distinct(outputs, inputs);
    require_endings(outputs);
}

// What goes on, on one line of a terminal; nothing elsewhere.
bench::Listener status_line() {
    if (isatty(STDERR_FILENO) == 0) return {};
    return [](const std::string& line) {
        say(stderr, "\r\x1b[K{}", line);
        static_cast<void>(std::fflush(stderr));
    };
}

// What was measured, and what came of comparing it.
struct Results {
    bench::Report report;
    std::optional<bench::Comparison> comparison;
    bench::Recording recording;
};

void write_files(const BenchOptions& options, const Results& results) {
    const bench::Report& report = results.report;
    const bench::Comparison* const comparison = results.comparison ? &*results.comparison : nullptr;
    if (!options.json.empty())
        image::write_file_atomically(options.json,
                                     bench::benchmark_json(report, comparison) + "\n");
    if (!options.csv.empty()) image::write_file_atomically(options.csv, bench::csv(report));
    if (!options.html.empty())
        image::write_file_atomically(options.html, bench::html_page(report, comparison));
    if (!options.trace.empty() && report.launches == 1)
        image::write_file_atomically(
            options.trace, profile::chrome_trace(results.recording.profile, "penumbra bench"));
}

// As many as the old report has, unless told.
int launches_of(const BenchOptions& options, const std::optional<bench::Report>& old) {
    if (old && options.launches > 0 && options.launches < bench::kFewestLaunches)
        throw InputError(fmt::format("--launches: expected at least {} with --compare, got {}",
                                     bench::kFewestLaunches, options.launches));
    if (options.launches > 0) return options.launches;
    return old ? old->launches : 1;
}

bench::Report obtain_report(const BenchOptions& options, const std::optional<bench::Report>& old,
                            const std::atomic<bool>& cancelled, bench::Recording& recording) {
    if (!options.from.empty()) return bench::read_report(options.from);
    bench::BenchSettings settings = interpret(options);
    const bench::Listener listener = status_line();
    const auto measured = [&] {
        const int launches = launches_of(options, old);
        if (launches > 1)
            return measure_in_launches(options, launches, old ? &*old : nullptr, listener,
                                       cancelled);
        std::vector<bench::Report> reports;
        for (const std::string& file : options.calls_of)
            reports.push_back(bench::read_report(file));
        for (const bench::Report& report : reports) settings.calls_of.push_back(&report);
        return bench::measure(settings, listener, cancelled,
                              options.trace.empty() ? nullptr : &recording);
    };
    bench::Report report = measured();
    if (listener) say(stderr, "\r\x1b[K");
    return report;
}

int run_bench(const BenchOptions& options) {
    static_cast<void>(interpret(options));
    require_files_of_their_own(options);
    const std::optional<bench::Report> old = read_old_report(options);
    const std::atomic<bool>& cancelled = catch_interrupts();
    Results results;
    results.report = obtain_report(options, old, cancelled, results.recording);
    if (cancelled) return interrupt_exit_code();
    say(stdout, "{}", bench::table(results.report));
    try {
        if (old) results.comparison = bench::compare(*old, results.report);
    } catch (const InputError&) {
        write_files(options, results);  // what was measured is not lost
        throw;
    }
    write_files(options, results);
    if (!results.comparison) return 0;
    say(stdout, "\n{}", bench::comparison_table(*results.comparison));
    return judge(*results.comparison, options);
}

}  // namespace

std::shared_ptr<BenchOptions> add_bench_command(CLI::App& app, int& exit_code) {
    auto options = std::make_shared<BenchOptions>();
    CLI::App* command =
        app.add_subcommand("bench", "Measure the passes of frames against the machine's limits");
    declare_options(*command, *options);
    command->footer(kBenchFooter);
    command->callback([options, command, &exit_code] {
        refuse_empty_values(*command);
        refuse_unheard(*command, *options);
        exit_code = run_bench(*options);
    });
    return options;
}

}  // namespace penumbra::cli
