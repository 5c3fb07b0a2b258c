#pragma once

#include <memory>
#include <string>

#include "apps/cli/diff_options.h"
#include "apps/diff/report.h"

namespace penumbra::cli {

// The numbers of all pairs as JSON; docs/diff.md explains the keys.
class DiffJson {
  public:
    DiffJson(const DiffOptions& options, const diff::CompareSettings& settings);
    ~DiffJson();
    void add(const diff::PairReport& pair);
    void write(const std::string& path, int exit_code) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra::cli
