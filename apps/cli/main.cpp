#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>

#include "apps/cli/bench_command.h"
#include "apps/cli/check_command.h"
#include "apps/cli/completion_command.h"
#include "apps/cli/diff_command.h"
#include "apps/cli/help_format.h"
#include "apps/cli/info_command.h"
#include "apps/cli/parse_errors.h"
#include "apps/cli/render_command.h"
#include "apps/cli/say.h"
#include "core/error.h"

namespace {

constexpr int kInputIsWrong = 2;
constexpr int kInputOutputFailed = 3;

constexpr const char* kFooter =
    "`penumbra COMMAND --help` explains a command. Defaults stand in [brackets].\n\n"
    "Exit codes:\n"
    "  0            done, also when nothing was left to do\n"
    "  1            a comparison failed\n"
    "  2            the command line or an input file is wrong\n"
    "  3            reading, writing or memory failed, or some frames of a range did\n"
    "  130 143 129  interrupted by Ctrl-C, SIGTERM or SIGHUP; what is on disk is whole";

int report(const std::string& message, int exit_code) {
    penumbra::cli::say_error(message);
    return exit_code;
}

int run(int argc, char** argv) {
    CLI::App app{"Direct light from area lights with soft shadows, on the CPU.", "penumbra"};
    app.set_version_flag("--version", "penumbra " PENUMBRA_VERSION, "Print the version and exit");
    app.require_subcommand(1);
    app.set_help_flag("-h,--help", "Explain this and exit");
    app.footer(kFooter);
    app.formatter(std::make_shared<penumbra::cli::HelpFormat>());

    int exit_code = 0;
    const auto render = penumbra::cli::add_render_command(app, exit_code);
    const auto info = penumbra::cli::add_info_command(app, exit_code);
    const auto diff = penumbra::cli::add_diff_command(app, exit_code);
    const auto bench = penumbra::cli::add_bench_command(app, exit_code);
    const auto check = penumbra::cli::add_check_command(app, argv[0], exit_code);
    penumbra::cli::add_completion_command(app);
    penumbra::cli::add_manual_command(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
        return report(penumbra::cli::explain(e, app), kInputIsWrong);
    }
    penumbra::cli::require_said();
    return exit_code;
}

}  // namespace

// The only place that turns failures into exit codes.
int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const penumbra::InputError& e) {
        return report(e.what(), kInputIsWrong);
    } catch (const std::bad_alloc&) {
        return report("out of memory", kInputOutputFailed);
    } catch (const std::exception& e) {
        return report(e.what(), kInputOutputFailed);
    }
}
