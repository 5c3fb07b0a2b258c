#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

namespace penumbra::cli {

// Adds `penumbra info`: what a scene or an EXR holds.
[[nodiscard]] std::shared_ptr<std::string> add_info_command(CLI::App& app, int& exit_code);

}  // namespace penumbra::cli
