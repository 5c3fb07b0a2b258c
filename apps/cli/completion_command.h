#pragma once

#include <CLI/CLI.hpp>

namespace penumbra::cli {

// Adds `penumbra completion SHELL` and `penumbra manual`, which print what an installation puts
// where shells and man look for it. They tell of all commands that `app` has when they run.
void add_completion_command(CLI::App& app);
void add_manual_command(CLI::App& app);

}  // namespace penumbra::cli
