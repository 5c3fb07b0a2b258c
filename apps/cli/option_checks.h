#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace penumbra::cli {

// A number from low to high (no limit: the largest double); refuses NaN, which CLI::Range lets
// pass.
[[nodiscard]] CLI::Validator in_range(double low, double high);

// What may be written, for help and completion; the command checks it. A list of these words with
// commas, or NAME=VALUE with one of them as the name.
[[nodiscard]] CLI::Validator list_of(const std::vector<std::string>& words);
[[nodiscard]] CLI::Validator value_of(const std::vector<std::string>& words);

// Throws InputError for an option or argument that was given as an empty text: an unset variable of
// a script must not mean "not given".
void refuse_empty_values(const CLI::App& command);

// A file that is going to be written, and the option that says so.
using PlannedFile = std::pair<std::string, std::filesystem::path>;

// Throws InputError if two of the files are the same, or one is among the inputs.
void require_distinct(const std::vector<PlannedFile>& outputs,
                      const std::vector<std::filesystem::path>& inputs);

// Throws InputError unless reports are named after what they hold (--html: .html, --junit: .xml,
// ...): a slip of the pen must not replace a picture or a model that no list of inputs knows.
void require_endings(const std::vector<PlannedFile>& reports);

}  // namespace penumbra::cli
