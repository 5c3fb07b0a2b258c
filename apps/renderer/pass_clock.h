#pragma once

#include "apps/renderer/frame_statistics.h"
#include "apps/renderer/settings.h"
#include "core/frame/tile.h"
#include "core/profile/profile.h"

// Where the passes' times come from: always the sums of the statistics, and a slice each where a
// profile is kept.

namespace penumbra::renderer {

// One worker's clock of the tile passes. They follow each other without a gap, so that one reading
// ends a pass and begins the next.
class PassClock {
  public:
    PassClock() = default;
    PassClock(const ExecutionSettings& execution, int worker)
        : track_(execution.profile ? &execution.profile->track(worker) : nullptr),
          on_pass_(execution.on_pass) {}

    void begin_tile(const Tile& tile) {
        x_ = tile.x0;
        y_ = tile.y0;
        begin_ = profile::now();
    }
    // The time since the tile began, or since the last call, was spent in this pass; on so many
    // rays, if it is about rays.
    void end(Pass pass, profile::Argument rays = {}) {
        if (on_pass_) (*on_pass_)(pass);
        const profile::Nanoseconds end = profile::now();
        seconds_[pass] += 1e-9 * static_cast<double>(end - begin_);
        if (track_)
            track_->add({.name = name(pass).data(),
                         .begin = begin_,
                         .end = end,
                         .first = {"x", x_},
                         .second = {"y", y_},
                         .third = rays,
                         .kind = profile::Kind::kPass});
        begin_ = end;
    }
    [[nodiscard]] const PassSeconds& seconds() const { return seconds_; }

  private:
    PassSeconds seconds_;
    profile::Track* track_ = nullptr;
    const PassObserver* on_pass_ = nullptr;
    profile::Nanoseconds begin_ = 0;
    int x_ = 0, y_ = 0;
};

// Its own lifetime as wall-clock seconds of a pass of the whole frame.
class FramePass {
  public:
    FramePass(Pass pass, profile::Profile* profile, FrameStatistics& statistics)
        : pass_(pass),
          statistics_(statistics),
          phase_(profile, name(pass).data()),
          begin_(profile::now()) {}
    ~FramePass() {
        statistics_.passes[pass_] += 1e-9 * static_cast<double>(profile::now() - begin_);
    }
    FramePass(const FramePass&) = delete;
    FramePass& operator=(const FramePass&) = delete;

  private:
    Pass pass_;
    FrameStatistics& statistics_;
    profile::Phase phase_;
    profile::Nanoseconds begin_;
};

}  // namespace penumbra::renderer
