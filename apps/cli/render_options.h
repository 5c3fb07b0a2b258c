#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "apps/cli/progress.h"
#include "apps/renderer/sequence.h"

namespace penumbra::cli {

// The options of `penumbra render`, as the user wrote them.
struct RenderOptions {
    std::string scene;   // empty: the built-in one
    std::string frames;  // empty: the scene's range
    std::string size, crop, aovs = "beauty";
    std::string method = "ratio", denoise = "noise-driven", compression = "zip", precision = "half";
    std::string noise_rule = "mean";
    std::string isa = "auto", trace_isa = "avx2", progress = "auto";
    std::string preview, statistics, trace;
    bool dry_run = false;
    renderer::ImageSettings image;
    renderer::ExecutionSettings execution;
    renderer::OutputSettings output;
};

// Declares the options with their defaults; each writes to `options` when the line is parsed.
void declare_options(CLI::App& command, RenderOptions& options);

// Turns the words of `options` into its settings. Throws InputError that names the option.
void interpret(RenderOptions& options);

[[nodiscard]] ProgressStyle progress_style(const RenderOptions& options);

}  // namespace penumbra::cli
