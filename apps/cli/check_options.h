#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "apps/check/accept_command.h"
#include "apps/check/run.h"

namespace penumbra::cli {

// The options of `penumbra check`, as the user wrote them.
struct CheckOptions {
    std::vector<std::string> paths, filters;
    bool list = false, update = false, bless_missing = false;
    std::string html, junit, json, output, renderer;
    // Options of `penumbra render` that are handed on to every render.
    std::map<std::string, std::string> render_values;
    std::map<std::string, bool> render_flags;
    int jobs = 0, threads = 0;  // 0: chosen by the run
    double timeout_seconds = 600;
};

void declare_options(CLI::App& command, CheckOptions& options);

// Without the folders, which only exist once a run begins. Throws InputError that names the option.
[[nodiscard]] check::RunSettings interpret(const CheckOptions& options);
[[nodiscard]] check::Invocation invocation_of(const CheckOptions& options,
                                              const std::string& program);

// Options of `penumbra render` that NAME.check.json may set: all but those that say where pictures
// go and those that are the run's, not the check's.
[[nodiscard]] std::vector<check::RenderOption> options_of_checks();

}  // namespace penumbra::cli
