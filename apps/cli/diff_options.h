#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/diff/compare_files.h"

namespace penumbra::cli {

// The options of `penumbra diff`, as the user wrote them.
struct DiffOptions {
    std::string reference, test;
    std::vector<std::string> fail_above, fail_below, ignored_layers, metrics;
    double pixel_threshold = 0;
    std::string mask, heatmap, json, html;
    int threads = 0;  // 0: what the surroundings allow
};

void declare_options(CLI::App& command, DiffOptions& options);

// What the words mean; `mask` must outlive the settings. Throws InputError that names the option.
[[nodiscard]] diff::CompareSettings interpret(const DiffOptions& options,
                                              std::optional<diff::Mask>& mask);

}  // namespace penumbra::cli
