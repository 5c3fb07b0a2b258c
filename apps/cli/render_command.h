#pragma once

#include <CLI/CLI.hpp>
#include <memory>

namespace penumbra::cli {

struct RenderOptions;

// Adds `penumbra render`; it runs while the command line is parsed and sets the exit code. The
// result owns what the options are written to.
[[nodiscard]] std::shared_ptr<RenderOptions> add_render_command(CLI::App& app, int& exit_code);

}  // namespace penumbra::cli
