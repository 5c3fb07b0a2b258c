#include "core/profile/timeline.h"

#include <algorithm>
#include <limits>

namespace penumbra::profile {
namespace {

bool begins_before(const Slice& a, const Slice& b) {
    if (a.begin != b.begin) return a.begin < b.begin;
    return a.end > b.end;
}

// Walks one thread's slices in order and fills the gaps.
class Weaver {
  public:
    explicit Weaver(Timeline& timeline) : timeline_(timeline) {
        open_.push_back({.end = timeline.end, .covered_to = timeline.begin, .has_gaps = true});
    }

    void add(const Slice& slice) {
        while (open_.size() > 1 && open_.back().end <= slice.begin) close();
        Open& parent = open_.back();
        fill(parent, slice.begin);
        parent.covered_to = slice.end;
        timeline_.entries.push_back({.slice = slice, .depth = depth()});
        open_.push_back(
            {.end = slice.end, .covered_to = slice.begin, .has_gaps = slice.kind == Kind::kLoop});
    }

    void finish() {
        while (!open_.empty()) close();
    }

  private:
    struct Open {
        Nanoseconds end;
        Nanoseconds covered_to;  // by what it holds
        bool has_gaps;           // what nothing covers is idle
    };

    [[nodiscard]] int depth() const { return static_cast<int>(open_.size()) - 1; }

    void fill(const Open& parent, Nanoseconds until) {
        if (!parent.has_gaps || until <= parent.covered_to) return;
        timeline_.entries.push_back(
            {.slice = {.name = "idle", .begin = parent.covered_to, .end = until},
             .is_idle = true,
             .depth = depth()});
    }

    void close() {
        fill(open_.back(), open_.back().end);
        open_.pop_back();
    }

    Timeline& timeline_;
    std::vector<Open> open_;
};

}  // namespace

std::vector<Timeline> timelines(const Profile& profile) {
    Nanoseconds begin = std::numeric_limits<Nanoseconds>::max();
    Nanoseconds end = std::numeric_limits<Nanoseconds>::min();
    for (int i = 0; i < profile.threads(); ++i)
        for (const Slice& slice : profile.track(i).slices()) {
            begin = std::min(begin, slice.begin);
            end = std::max(end, slice.end);
        }
    std::vector<Timeline> all;
    if (begin > end) return all;
    for (int i = 0; i < profile.threads(); ++i) {
        const std::span<const Slice> recorded = profile.track(i).slices();
        std::vector<Slice> slices(recorded.begin(), recorded.end());
        // Inner slices were added first; of equal ones the outer was added last.
        std::reverse(slices.begin(), slices.end());
        std::stable_sort(slices.begin(), slices.end(), begins_before);
        Timeline& timeline = all.emplace_back();
        timeline.begin = begin;
        timeline.end = end;
        Weaver weaver(timeline);
        for (const Slice& slice : slices) weaver.add(slice);
        weaver.finish();
    }
    return all;
}

Nanoseconds total(const Profile& profile, Kind kind, std::string_view name) {
    Nanoseconds sum = 0;
    for (int i = 0; i < profile.threads(); ++i)
        for (const Slice& slice : profile.track(i).slices())
            if (slice.kind == kind && slice.name == name) sum += slice.end - slice.begin;
    return sum;
}

}  // namespace penumbra::profile
