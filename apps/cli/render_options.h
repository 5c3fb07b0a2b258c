#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "apps/cli/progress.h"
#include "apps/cli/setting_options.h"
#include "apps/renderer/sequence.h"

namespace penumbra::cli {

// The options of `penumbra render`: settings that are written in words are their defaults until
// interpret().
struct RenderOptions {
    std::string scene;   // empty: the built-in one
    std::string frames;  // empty: the scene's range
    SettingTexts texts;
    std::string statistics, trace;
    ProgressStyle progress = ProgressStyle::kAuto;
    bool dry_run = false;
    renderer::ImageSettings image;
    renderer::ExecutionSettings execution;
    renderer::OutputSettings output;
};

// Declares the options with their defaults; each writes to `options` when the line is parsed.
void declare_options(CLI::App& command, RenderOptions& options);

// Turns the words of `options` into its settings. Throws InputError that names the option.
void interpret(RenderOptions& options);

}  // namespace penumbra::cli
