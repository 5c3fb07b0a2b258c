#include "apps/cli/check_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>

#include "apps/check/html_report.h"
#include "apps/check/junit.h"
#include "apps/check/temporary_folder.h"
#include "apps/cli/check_json.h"
#include "apps/cli/check_options.h"
#include "apps/cli/option_checks.h"
#include "apps/cli/say.h"
#include "apps/cli/signals.h"
#include "core/error.h"
#include "core/image/publish.h"
#include "core/profile/stopwatch.h"

namespace penumbra::cli {
namespace {

namespace fs = std::filesystem;
using check::CheckOutcome;
using check::Verdict;

constexpr const char* kCheckFooter =
    "Beside the scene NAME.json lie NAME.golden.exr, what it has to look like "
    "(NAME.golden.0012.exr\n"
    "for each of several frames), and NAME.check.json, how it is rendered and how much may "
    "differ:\n"
    "  { \"render\": { \"size\": \"320x180\", \"frames\": \"1,24\", \"aov\": \"beauty,N,Z\" },\n"
    "    \"diff\": { \"fail-above\": [\"flip=0.01\"] }, \"reason\": \"why it may differ\" }\n"
    "All of it is optional; without limits any difference fails. docs/check.md tells the rest.\n\n"
    "Exit codes: 0 all pass, 1 pictures differ or goldens are missing or unfit, 2 a scene, its\n"
    "settings or the command line is wrong, 3 a scene failed to render. The highest one counts.\n\n"
    "Examples:\n"
    "  penumbra check shot.json --bless-missing       make the first golden\n"
    "  penumbra check tests/ --html report.html --junit report.xml\n"
    "  penumbra check tests/ --filter teapot --update";

void print(const CheckOutcome& outcome) {
    const Verdict verdict = outcome.verdict();
    const std::string name(check::name(verdict));
    say(stdout, "{:<8} {:>7.2f} s  {}\n", name, outcome.seconds, outcome.check.name);
    for (const std::string& warning : outcome.warnings) say(stderr, "warning: {}\n", warning);
    if (outcome.error) {
        say(stderr, "error: {}: {}\n", outcome.check.name, outcome.error->message);
        return;
    }
    for (const std::string& line : check::problems(outcome)) say(stdout, "    {}\n", line);
    std::fflush(stdout);
}

// What judging and writing goldens changed after the check was reported, if it was.
void print_changes(const std::vector<CheckOutcome>& outcomes, const std::vector<Verdict>& before) {
    for (std::size_t i = 0; i < std::min(outcomes.size(), before.size()); ++i) {
        const CheckOutcome& outcome = outcomes[i];
        if (outcome.verdict() == before[i]) continue;
        if (outcome.error) {
            say(stderr, "error: {}: {}\n", outcome.check.name, outcome.error->message);
            continue;
        }
        for (const check::FrameOutcome& frame : outcome.frames) {
            if (frame.verdict == Verdict::kUnfit)
                say(stdout, "unfit golden: {}: {}\n", outcome.check.name, frame.message);
            if (frame.verdict == Verdict::kUpdated || frame.verdict == Verdict::kBlessed)
                say(stdout, "{}: {}\n", check::name(frame.verdict), frame.golden.string());
        }
    }
}

void print_summary(const std::vector<CheckOutcome>& outcomes, double seconds) {
    std::string counts;
    for (const Verdict verdict :
         {Verdict::kPassed, Verdict::kUpdated, Verdict::kBlessed, Verdict::kMissing,
          Verdict::kFailed, Verdict::kUnfit, Verdict::kError}) {
        const auto count =
            std::count_if(outcomes.begin(), outcomes.end(),
                          [&](const CheckOutcome& each) { return each.verdict() == verdict; });
        if (count > 0)
            counts +=
                fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, check::name(verdict));
    }
    say(stdout, "{} {}: {} in {:.2f} s\n", outcomes.size(),
        outcomes.size() == 1 ? "check" : "checks", counts, seconds);
}

void print_accept_command(const CheckOptions& options, const check::Invocation& invocation,
                          const std::vector<CheckOutcome>& outcomes) {
    const std::string command = check::accept_command(invocation, outcomes);
    if (command.empty()) return;
    if (options.html.empty()) say(stdout, "Add --html FILE.html to see the pictures. ");
    say(stdout, "To accept the new pictures:\n  {}\n", command);
}

int list(const std::vector<check::Check>& checks) {
    for (const check::Check& each : checks) {
        const std::size_t goldens = check::existing_goldens(each.name).size();
        const std::string count = goldens == 1   ? "1 golden"
                                  : goldens == 0 ? "no golden"
                                                 : fmt::format("{} goldens", goldens);
        say(stdout, "{}\t{}\t{}\n", each.name,
            each.settings.empty() ? each.scene.string() : each.settings.string(), count);
    }
    return 0;
}

std::string html_file(const std::string& html) {
    std::error_code ignored;
    const bool is_folder = html.ends_with('/') || fs::is_directory(html, ignored);
    return is_folder ? (fs::path(html) / "index.html").string() : html;
}

void require_files_of_their_own(const CheckOptions& options,
                                const std::vector<check::Check>& checks) {
    std::vector<PlannedFile> outputs;
    if (!options.html.empty()) outputs.emplace_back("--html", html_file(options.html));
    if (!options.junit.empty()) outputs.emplace_back("--junit", options.junit);
    if (!options.json.empty()) outputs.emplace_back("--json", options.json);
    std::vector<fs::path> inputs;
    for (const check::Check& each : checks) {
        inputs.push_back(each.scene);
        inputs.push_back(each.settings);
        for (const fs::path& golden : check::existing_goldens(each.name)) inputs.push_back(golden);
    }
    std::erase(inputs, fs::path{});
    require_distinct(outputs, inputs);
    require_endings(outputs);
}

// One that cannot be written does not keep the others from it.
void write_reports(const CheckOptions& options, const check::Invocation& invocation,
                   const std::vector<CheckOutcome>& outcomes, double seconds) {
    std::exception_ptr first_failure;
    const auto attempt = [&first_failure](const std::string& file, const auto& write) {
        if (file.empty()) return;
        try {
            write();
        } catch (...) {
            if (!first_failure) first_failure = std::current_exception();
        }
    };
    attempt(options.junit, [&] {
        image::write_file_atomically(options.junit, check::junit_xml(outcomes, seconds));
    });
    attempt(options.json, [&] {
        image::write_file_atomically(
            options.json, check_json(outcomes, check::accept_command(invocation, outcomes)));
    });
    attempt(options.html,
            [&] { check::write_html_report(html_file(options.html), outcomes, invocation); });
    if (first_failure) std::rethrow_exception(first_failure);
}

int run(const CheckOptions& options, const std::string& program) {
    const profile::Stopwatch watch;
    const std::vector<check::Check> checks =
        check::filtered(check::find_checks(options.paths), options.filters);
    if (options.list) return list(checks);
    require_files_of_their_own(options, checks);
    check::RunSettings settings = interpret(options);
    const check::TemporaryFolder scratch;
    settings.scratch = scratch.path() / "pictures";
    settings.renders =
        options.output.empty() ? scratch.path() / "renders" : fs::path(options.output);
    const std::atomic<bool>& cancelled = catch_interrupts();
    std::vector<Verdict> verdicts;
    const std::vector<CheckOutcome> outcomes = check::run_checks(
        checks, settings,
        [&](const CheckOutcome& outcome) {
            print(outcome);
            verdicts.push_back(outcome.verdict());
        },
        cancelled);
    print_changes(outcomes, verdicts);  // goldens are written, whatever happened then
    if (cancelled.load()) return interrupt_exit_code();
    const check::Invocation invocation = invocation_of(options, program);
    print_summary(outcomes, watch.seconds());
    print_accept_command(options, invocation, outcomes);
    write_reports(options, invocation, outcomes, watch.seconds());
    return check::exit_code(outcomes);
}

}  // namespace

std::shared_ptr<CheckOptions> add_check_command(CLI::App& app, const std::string& program,
                                                int& exit_code) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* command =
        app.add_subcommand("check", "Render scenes and compare them with their golden images");
    declare_options(*command, *options);
    command->footer(kCheckFooter);
    command->callback([options, command, program, &exit_code] {
        refuse_empty_values(*command);
        exit_code = run(*options, program);
    });
    return options;
}

}  // namespace penumbra::cli
