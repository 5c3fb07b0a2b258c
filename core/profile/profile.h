#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

// Who did what when: slices of time per thread, for a trace and for sums over threads. The caller
// owns the profile and hands it to those who record; a null pointer records nothing and costs a
// test.

namespace penumbra::profile {

using Nanoseconds = std::int64_t;  // of a clock that never goes back; its zero means nothing

[[nodiscard]] inline Nanoseconds now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// A number that a slice carries. Keys, like names, are texts that outlive the profile.
struct Argument {
    const char* key = nullptr;  // null: none
    std::int64_t value = 0;
};

enum class Kind : std::uint8_t {
    kPhase,  // a part of the frame, on the thread that leads it
    kLoop,   // a parallel loop, likewise; between its tasks that thread waits
    kTask,   // one call of a parallel loop's body
    kPass,   // a part of a task
};

struct Slice {
    const char* name = nullptr;
    Nanoseconds begin = 0, end = 0;
    Argument first, second, third;
    Kind kind = Kind::kPhase;
};

// What one thread did. Slices are added when they end: inner ones before outer ones.
class alignas(64) Track {
  public:
    // Never allocates: where no room is left, the slice is counted and dropped.
    void add(const Slice& slice) {
        if (slices_.size() < slices_.capacity())
            slices_.push_back(slice);
        else
            ++dropped_;
    }
    [[nodiscard]] std::span<const Slice> slices() const { return slices_; }
    [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

  private:
    friend class Profile;
    std::vector<Slice> slices_;
    std::uint64_t dropped_ = 0;
};

class Profile {
  public:
    // Slices that a thread has room for between two calls of make_room, and in all.
    explicit Profile(std::size_t room = 1u << 17, std::size_t most = 1u << 22)
        : room_(room), most_(most) {}

    // While nothing is recorded: at least that many tracks; room on each for the next frame;
    // forgets all slices.
    void make_tracks(int threads);
    void make_room();
    void clear();

    [[nodiscard]] int threads() const { return static_cast<int>(tracks_.size()); }
    // A worker's own track; one thread at a time.
    [[nodiscard]] Track& track(int worker) { return *tracks_[static_cast<std::size_t>(worker)]; }
    [[nodiscard]] const Track& track(int worker) const {
        return *tracks_[static_cast<std::size_t>(worker)];
    }

    // What the leading thread is at: loops and tasks are named after it.
    [[nodiscard]] const char* phase() const { return phase_; }
    // Returns the phase before.
    const char* enter(const char* phase);

    [[nodiscard]] std::uint64_t dropped() const;

  private:
    std::size_t room_;
    std::size_t most_;
    std::vector<std::unique_ptr<Track>> tracks_;
    const char* phase_ = "loop";
};

// Its own lifetime as a slice of a worker's track.
class Scope {
  public:
    Scope(Profile* profile, int worker, Kind kind, const char* name, Argument first = {},
          Argument second = {}) {
        if (!profile) return;
        track_ = &profile->track(worker);
        slice_ = {.name = name, .begin = now(), .first = first, .second = second, .kind = kind};
    }
    ~Scope() {
        if (!track_) return;
        slice_.end = now();
        track_->add(slice_);
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

  private:
    Track* track_ = nullptr;
    Slice slice_;
};

// A part of the frame, by the thread that leads it: worker 0's track.
class Phase {
  public:
    Phase(Profile* profile, const char* name, Argument first = {})
        : profile_(profile),
          before_(profile ? profile->enter(name) : nullptr),
          scope_(profile, 0, Kind::kPhase, name, first) {}
    ~Phase() {
        if (profile_) profile_->enter(before_);
    }
    Phase(const Phase&) = delete;
    Phase& operator=(const Phase&) = delete;

  private:
    Profile* profile_;
    const char* before_;
    Scope scope_;
};

}  // namespace penumbra::profile
