#include "apps/cli/check_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "apps/cli/option_checks.h"
#include "apps/cli/render_options.h"
#include "core/error.h"

namespace penumbra::cli {
namespace {

// What `penumbra render` takes, without rendering.
struct RenderTable {
    RenderOptions values;
    CLI::App app;
    RenderTable() { declare_options(app, values); }
};

const std::set<std::string> kNotOfChecks = {"help",     "output",   "resume", "dry-run",
                                            "preview",  "exposure", "stats",  "trace",
                                            "progress", "threads",  "isa"};
// Those with which the same goldens are tried again.
constexpr const char* kHandedOn[] = {"isa", "trace-isa", "reproducible"};

std::string name_of(const CLI::Option& option) {
    return option.get_lnames().empty() ? "" : option.get_lnames().front();
}

bool is_flag(const CLI::Option& option) {
    return option.get_items_expected_max() == 0;
}

void declare_what(CLI::App& command, CheckOptions& o) {
    command
        .add_option(
            "PATHS", o.paths,
            "Scenes (.json), models (.obj), NAME.check.json, or folders, which are searched "
            "for NAME.check.json and NAME.golden.exr")
        ->type_name("PATH")
        ->required();
    command.option_defaults()->group("What is checked");
    command
        .add_option("--filter", o.filters,
                    "Only checks whose name holds this text, in which * and ? stand for others; "
                    "repeatable")
        ->type_name("TEXT")
        ->allow_extra_args(false);
    command.add_flag("--list", o.list, "Print what would be checked, render nothing");
}

void declare_goldens(CLI::App& command, CheckOptions& o) {
    command.option_defaults()->group("Accepting");
    command.add_flag(
        "--update", o.update,
        "Replace the goldens that fail by the new pictures; those that pass keep their "
        "bytes");
    command.add_flag("--bless-missing", o.bless_missing,
                     "Make the new pictures the goldens where there are none");
}

void declare_reports(CLI::App& command, CheckOptions& o) {
    command.option_defaults()->group("Reports");
    command
        .add_option("--html", o.html,
                    "Write a page with pictures: new, golden, difference; a folder gets index.html")
        ->type_name("FILE.html");
    command.add_option("--junit", o.junit, "Write the results for a CI service")
        ->type_name("FILE.xml");
    command.add_option("--json", o.json, "Write all results")->type_name("FILE.json");
    command
        .add_option("-o,--output", o.output,
                    "Keep the new pictures and what the renderer said here [they are dropped]")
        ->type_name("FOLDER");
}

void declare_handed_on(CLI::App& command, CheckOptions& o) {
    RenderTable table;
    for (const char* const name : kHandedOn) {
        const std::string flag = std::string("--") + name;
        CLI::Option* const option = table.app.get_option_no_throw(flag);
        if (option == nullptr) continue;
        const std::string help = option->get_description() + " [each check's]";
        if (is_flag(*option)) {
            command.add_flag(flag, o.render_flags[name], help);
            continue;
        }
        CLI::Option* const own = command.add_option(flag, o.render_values[name], help);
        own->type_name(option->get_type_name());
        if (const auto* validator = option->get_validator(0)) own->check(*validator);
    }
}

void declare_running(CLI::App& command, CheckOptions& o) {
    command.option_defaults()->group("Running");
    command
        .add_option(
            "-j,--jobs", o.jobs,
            "Scenes rendered at once [as many as there are threads, less where memory would "
            "not do]")
        ->check(in_range(1, 1024));
    command
        .add_option("--threads", o.threads,
                    "Threads of each render; changes no pixel [those allowed, shared by the jobs]")
        ->check(in_range(1, 1024));
    declare_handed_on(command, o);
    command.add_option("--timeout", o.timeout_seconds, "Seconds after which a render is ended")
        ->check(in_range(0.001, 1e6))
        ->capture_default_str();
    command
        .add_option("--renderer", o.renderer,
                    "The program that renders, called like this one: another build, or a script "
                    "[this one]")
        ->type_name("PROGRAM");
}

std::filesystem::path program_of(const std::string& renderer) {
    if (renderer.empty()) return std::filesystem::read_symlink("/proc/self/exe");
    if (!std::filesystem::is_regular_file(renderer))
        throw InputError("--renderer: there is no such program: " + renderer);
    return std::filesystem::absolute(renderer);
}

}  // namespace

void declare_options(CLI::App& command, CheckOptions& o) {
    declare_what(command, o);
    declare_goldens(command, o);
    declare_reports(command, o);
    declare_running(command, o);
}

std::vector<check::RenderOption> options_of_checks() {
    RenderTable table;
    std::vector<check::RenderOption> options;
    for (const CLI::Option* option : table.app.get_options())
        if (const std::string name = name_of(*option);
            !name.empty() && !kNotOfChecks.contains(name))
            options.push_back({name, is_flag(*option)});
    return options;
}

check::RunSettings interpret(const CheckOptions& o) {
    check::RunSettings settings;
    settings.render = {.program = program_of(o.renderer),
                       .options = options_of_checks(),
                       .timeout_seconds = o.timeout_seconds};
    for (const auto& [name, value] : o.render_values) {
        if (value.empty()) continue;
        settings.render.overrides[name] = value;
        if (kNotOfChecks.contains(name)) settings.render.options.push_back({name, false});
    }
    for (const auto& [name, is_set] : o.render_flags)
        if (is_set) settings.render.overrides[name] = "true";
    settings.jobs = o.jobs;
    settings.threads = o.threads;
    settings.wants_pictures = !o.html.empty();
    settings.may_update = o.update;
    settings.may_bless = o.bless_missing;
    return settings;
}

check::Invocation invocation_of(const CheckOptions& o, const std::string& program) {
    check::Invocation invocation{.program = program, .selection = o.paths, .options = {}};
    for (const std::string& filter : o.filters)
        invocation.selection.push_back("--filter=" + filter);
    for (const auto& [name, value] : o.render_values)
        if (!value.empty()) invocation.options.push_back(fmt::format("--{}={}", name, value));
    for (const auto& [name, is_set] : o.render_flags)
        if (is_set) invocation.options.push_back("--" + name);
    if (!o.renderer.empty()) invocation.options.push_back("--renderer=" + o.renderer);
    return invocation;
}

}  // namespace penumbra::cli
