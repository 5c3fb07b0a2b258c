#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

namespace penumbra::cli {

struct CheckOptions;

// Adds `penumbra check`: renders scenes and compares them with their goldens. `program` is what the
// user called, for the commands that are printed.
[[nodiscard]] std::shared_ptr<CheckOptions> add_check_command(CLI::App& app,
                                                              const std::string& program,
                                                              int& exit_code);

}  // namespace penumbra::cli
