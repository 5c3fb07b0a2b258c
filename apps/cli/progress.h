#pragma once

#include <memory>
#include <string_view>

#include "apps/renderer/sequence.h"

namespace penumbra::cli {

enum class ProgressStyle {
    kAuto,    // a status line with ETA on a terminal, else a line per frame
    kPlain,   // a line per frame
    kJson,    // a JSON object per line and frame
    kOpenJd,  // openjd_progress and openjd_status lines for render farms
    kNone,
};

// Tells how far a sequence is, on standard output.
class Progress {
  public:
    Progress(ProgressStyle style, int frame_count);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void report(const renderer::FrameReport& frame);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra::cli
