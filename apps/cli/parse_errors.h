#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace penumbra::cli {

// What is wrong with the command line, in the words of all our errors: what was expected, what was
// found, and the nearest thing that exists.
[[nodiscard]] std::string explain(const CLI::ParseError& error, const CLI::App& app);

}  // namespace penumbra::cli
