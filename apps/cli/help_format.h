#pragma once

#include <CLI/CLI.hpp>

namespace penumbra::cli {

// The text of --help: lines that fit the terminal, options by group, each with its words, range and
// default.
class HelpFormat : public CLI::Formatter {
  public:
    std::string make_help(const CLI::App* app, std::string name,
                          CLI::AppFormatMode mode) const override;
};

}  // namespace penumbra::cli
