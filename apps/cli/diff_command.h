#pragma once

#include <CLI/CLI.hpp>
#include <memory>

namespace penumbra::cli {

struct DiffOptions;

// Adds `penumbra diff`: what differs between two images, and whether that is too much.
[[nodiscard]] std::shared_ptr<DiffOptions> add_diff_command(CLI::App& app, int& exit_code);

}  // namespace penumbra::cli
