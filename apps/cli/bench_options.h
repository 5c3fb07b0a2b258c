#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/bench/measure.h"
#include "apps/cli/setting_options.h"

namespace penumbra::cli {

// The options of `penumbra bench`, as the user wrote them; settings that are written in words are
// their defaults until interpret().
struct BenchOptions {
    std::vector<std::string> scenes;
    SettingTexts texts;
    renderer::ImageSettings image;
    renderer::ExecutionSettings execution;
    std::vector<int> threads;
    int frame = 0;
    int warmups = 2;
    int repetitions = 11;
    int launches = 0;     // 0: as is fit
    double patience = 5;  // seconds
    std::string json, csv, trace, html;
    std::string from, compare;
    std::vector<std::string> calls_of;
    std::optional<double> fail_slower;
};

void declare_options(CLI::App& command, BenchOptions& options);

// Throws InputError if an option was given that would not be heard: of measuring where nothing is
// measured, or of comparing where nothing is compared.
void refuse_unheard(const CLI::App& command, const BenchOptions& options);

// What the words mean. Throws InputError that names the option.
[[nodiscard]] bench::BenchSettings interpret(const BenchOptions& options);

}  // namespace penumbra::cli
