#pragma once

#include <CLI/CLI.hpp>
#include <memory>

namespace penumbra::cli {

struct BenchOptions;

// Adds `penumbra bench`: where a frame's time goes, and how far that is from the machine's limits.
[[nodiscard]] std::shared_ptr<BenchOptions> add_bench_command(CLI::App& app, int& exit_code);

}  // namespace penumbra::cli
