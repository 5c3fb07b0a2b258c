#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "apps/check/child_process.h"
#include "apps/check/outcome.h"
#include "core/profile/stopwatch.h"

namespace penumbra::check {

// How renders are made: `program render SCENE -o PATTERN ...` in a process of its own.
struct RenderSettings {
    std::filesystem::path program;
    std::vector<RenderOption> options;  // those a check may set
    RenderValues overrides;             // stronger than a check's
    int threads = 1;
    double timeout_seconds = 600;
};

struct RenderedFrame {
    std::string number;  // "0012"
    std::filesystem::path file;
};

// One scene on its way to pictures.
class RenderJob {
  public:
    // `stem` is the beginning of the pictures' and the log's names; what lies there from an earlier
    // run is removed. Throws OutputError.
    RenderJob(const Check& check, const CheckSettings& settings, const RenderSettings& how,
              std::filesystem::path stem);

    // Is it at its end? Kills it after the time-out.
    [[nodiscard]] bool poll();
    // What it was, and its frames where they are all there; after poll() was true.
    void describe(CheckOutcome& outcome) const;
    [[nodiscard]] std::vector<RenderedFrame> frames() const;

  private:
    [[nodiscard]] std::filesystem::path log_file() const;
    [[nodiscard]] std::optional<Error> error() const;
    [[nodiscard]] std::string message() const;

    std::filesystem::path stem_;
    std::map<std::string, std::string> places_;  // where options come from that a file sets
    std::vector<std::string> command_;
    double timeout_seconds_;
    bool is_timed_out_ = false;
    std::string log_;
    profile::Stopwatch watch_;
    double seconds_ = 0;
    ChildProcess process_;
    ChildProcess::Ending ending_;
};

}  // namespace penumbra::check
