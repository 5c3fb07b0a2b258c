#include "apps/cli/bench_launches.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "apps/bench/comparison.h"
#include "apps/bench/report_reader.h"
#include "apps/check/child_process.h"
#include "apps/check/temporary_folder.h"
#include "core/error.h"

namespace penumbra::cli {
namespace {

namespace fs = std::filesystem;

void add(std::vector<std::string>& argv, const std::string& option, const std::string& value) {
    if (!value.empty()) argv.push_back(fmt::format("{}={}", option, value));
}

// One launch: what was asked for, but for what happens to all launches together.
std::vector<std::string> command(const BenchOptions& o, const fs::path& report) {
    std::vector<std::string> argv{fs::read_symlink("/proc/self/exe").string(), "bench"};
    add(argv, "--launches", "1");
    add(argv, "--json", report.string());
    if (o.frame > 0) add(argv, "--frame", std::to_string(o.frame));
    if (const int samples = o.image.samples_per_pixel; samples > 0)
        add(argv, "--spp", std::to_string(samples));
    if (!o.threads.empty()) add(argv, "--threads", fmt::format("{}", fmt::join(o.threads, ",")));
    add(argv, "--warmup", std::to_string(o.warmups));
    add(argv, "--repetitions", std::to_string(o.repetitions));
    add(argv, "--patience", fmt::format("{}", o.patience));
    for (const auto& [setting, text] : o.texts) add(argv, "--" + setting, text);
    return argv;
}

void add_scenes(const BenchOptions& o, std::vector<std::string>& argv) {
    argv.emplace_back("--");
    argv.insert(argv.end(), o.scenes.begin(), o.scenes.end());
}

std::string last_error(const fs::path& log) {
    constexpr std::string_view kError = "error: ";
    std::ifstream lines(log);
    std::string message;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(kError)) message = line.substr(kError.size());
    return message;
}

// False where it was cancelled. Throws what made the launch fail.
bool run(const std::vector<std::string>& argv, const fs::path& log,
         const std::atomic<bool>& cancelled) {
    check::ChildProcess process(argv, log);
    std::optional<check::ChildProcess::Ending> ending;
    while (!(ending = process.poll())) {
        if (cancelled) return false;
        // Rare enough not to be a load of its own.
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    if (ending->signal != 0)
        throw OutputError(fmt::format("a launch was ended by signal {}: {}", ending->signal,
                                      strsignal(ending->signal)));
    if (ending->exit_code == 0) return true;
    const std::string message = last_error(log);
    if (ending->exit_code == 2) throw InputError(message);
    throw OutputError(
        fmt::format("a launch ended with exit code {}: {}", ending->exit_code, message));
}

// Adds a launch's repetitions to those of the others.
void merge(const bench::Report& launch, int index, bench::Report& all) {
    if (index == 0) all = launch;
    all.launches = index + 1;
    for (std::size_t s = 0; s < all.scenes.size(); ++s) {
        all.scenes[s].peak_memory_bytes =
            std::max(all.scenes[s].peak_memory_bytes, launch.scenes[s].peak_memory_bytes);
        for (std::size_t r = 0; r < all.scenes[s].runs.size(); ++r)
            for (std::size_t p = 0; p < all.scenes[s].runs[r].passes.size(); ++p) {
                std::vector<bench::Sample>& samples = all.scenes[s].runs[r].passes[p].samples;
                if (index == 0) samples.clear();
                for (bench::Sample sample : launch.scenes[s].runs[r].passes[p].samples) {
                    sample.launch = index;
                    samples.push_back(sample);
                }
            }
    }
}

}  // namespace

bench::Report measure_in_launches(const BenchOptions& options, int launches,
                                  const bench::Report* old, const bench::Listener& listener,
                                  const std::atomic<bool>& cancelled) {
    const check::TemporaryFolder folder;
    const fs::path first = folder.path() / "launch0.json";
    bench::Report all;
    for (int i = 0; i < launches && !cancelled; ++i) {
        if (listener) listener(fmt::format("launch {} of {}", i + 1, launches));
        const fs::path report = folder.path() / fmt::format("launch{}.json", i);
        std::vector<std::string> argv = command(options, report);
        // The first launch has calls also for what older reports have not.
        if (options.calls_of.empty()) add(argv, "--calls-of", options.compare);
        for (const std::string& older : options.calls_of) add(argv, "--calls-of", older);
        if (i > 0) add(argv, "--calls-of", first.string());
        if (i + 1 == launches) add(argv, "--trace", options.trace);
        add_scenes(options, argv);
        if (!run(argv, folder.path() / "log", cancelled)) break;
        merge(bench::read_report(report), i, all);
        if (i == 0 && old) bench::require_common(*old, all);
    }
    return all;
}

}  // namespace penumbra::cli
