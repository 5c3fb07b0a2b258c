#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>

#include "apps/cli/diff_command.h"
#include "apps/cli/info_command.h"
#include "apps/cli/render_command.h"
#include "apps/cli/say.h"
#include "core/error.h"

namespace {

constexpr int kInputIsWrong = 2;
constexpr int kInputOutputFailed = 3;

int report(const std::string& message, int exit_code) {
    penumbra::cli::say(stderr, "error: {}\n", message);
    return exit_code;
}

int run(int argc, char** argv) {
    CLI::App app{"Direct light from area lights with soft shadows, on the CPU.", "penumbra"};
    app.set_version_flag("--version", "penumbra " PENUMBRA_VERSION);
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);

    int exit_code = 0;
    const auto render = penumbra::cli::add_render_command(app, exit_code);
    const auto info = penumbra::cli::add_info_command(app, exit_code);
    const auto diff = penumbra::cli::add_diff_command(app, exit_code);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
        return report(e.what(), kInputIsWrong);
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
