#include "apps/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/cli/say.h"
#include "core/profile/stopwatch.h"

namespace penumbra::cli {
namespace {

using renderer::FrameOutcome;
using renderer::FrameReport;

std::string_view name(FrameOutcome outcome) {
    switch (outcome) {
        case FrameOutcome::kRendered:
            return "rendered";
        case FrameOutcome::kSkipped:
            return "skipped";
        case FrameOutcome::kFailed:
            return "failed";
    }
    return "";
}

// 75 s -> "1:15"; 3675 s -> "1:01:15".
std::string duration(double seconds) {
    const long long whole = std::llround(seconds);
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

struct Progress::State {
    ProgressStyle style;
    bool rewrites_line;  // on a terminal
    int frame_count;
    int done = 0;
    int rendered = 0;
    profile::Stopwatch watch;

    // Skipped frames take no time, so the estimate counts rendered ones alone.
    [[nodiscard]] double remaining_seconds() const {
        return rendered == 0 ? 0 : watch.seconds() / rendered * (frame_count - done);
    }
    void plain(const FrameReport& frame) const;
    void json(const FrameReport& frame) const;
    void openjd(const FrameReport& frame) const;
};

void Progress::State::plain(const FrameReport& frame) const {
    const double render_ms = 1e3 * frame.statistics.render_seconds;
    const std::string what =
        frame.outcome == FrameOutcome::kRendered
            ? fmt::format("{:.0f} ms, {:.1f} Mrays", render_ms, 1e-6 * frame.statistics.shadow_rays)
            : std::string(name(frame.outcome));
    const std::string line = fmt::format("frame {} ({}/{}): {}, ETA {}", frame.frame, done,
                                         frame_count, what, duration(remaining_seconds()));
    if (rewrites_line)
        say(stdout, "\r\x1b[K{}{}", line, done == frame_count ? "\n" : "");
    else
        say(stdout, "{}\n", line);
}

void Progress::State::json(const FrameReport& frame) const {
    const nlohmann::json line = {{"frame", frame.frame},
                                 {"outcome", name(frame.outcome)},
                                 {"done", done},
                                 {"frames", frame_count},
                                 {"path", frame.path},
                                 {"render_seconds", frame.statistics.render_seconds},
                                 {"remaining_seconds", remaining_seconds()}};
    say(stdout, "{}\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void Progress::State::openjd(const FrameReport& frame) const {
    say(stdout, "openjd_progress: {:.2f}\n", 100.0 * done / frame_count);
    say(stdout, "openjd_status: frame {} {} ({}/{})\n", frame.frame, name(frame.outcome), done,
        frame_count);
}

Progress::Progress(ProgressStyle style, int frame_count)
    : state_(std::make_unique<State>(
          State{.style = style,
                .rewrites_line = style == ProgressStyle::kAuto && isatty(STDOUT_FILENO) != 0,
                .frame_count = frame_count})) {}

Progress::~Progress() = default;

void Progress::report(const FrameReport& frame) {
    ++state_->done;
    if (frame.outcome == FrameOutcome::kRendered) ++state_->rendered;
    switch (state_->style) {
        case ProgressStyle::kAuto:
        case ProgressStyle::kPlain:
            state_->plain(frame);
            break;
        case ProgressStyle::kJson:
            state_->json(frame);
            break;
        case ProgressStyle::kOpenJd:
            state_->openjd(frame);
            break;
        case ProgressStyle::kNone:
            return;
    }
    std::fflush(stdout);
}

}  // namespace penumbra::cli
