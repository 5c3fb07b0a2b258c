#pragma once

#include <map>
#include <string_view>
#include <tuple>

#include "core/profile/profile.h"

namespace penumbra::bench {

// What work costs where nothing disturbs it: of each task, and of each pass of a tile, the quickest
// of all repetitions, summed up. A neighbour who comes and goes slows down every repetition
// somewhere, but hardly the same tile in all of them.
class Floors {
  public:
    // One repetition's slices, which are those of the same work each time.
    void add(const profile::Profile& profile);

    // Of all slices with this kind and name, and of all threads, in milliseconds. Of a phase: what
    // it takes outside of its loops. 0 where there are none, or a profile had no room for all.
    [[nodiscard]] double milliseconds(profile::Kind kind, std::string_view name) const;

  private:
    struct Key {
        profile::Kind kind;
        std::string_view name;
        std::int64_t first, second;  // which task or tile
        friend bool operator<(const Key& a, const Key& b) {
            return std::tie(a.kind, a.name, a.first, a.second) <
                   std::tie(b.kind, b.name, b.first, b.second);
        }
    };
    using Times = std::map<Key, profile::Nanoseconds>;
    [[nodiscard]] static Times times(const profile::Profile& profile);

    Times least_;
    bool is_complete_ = true;
};

}  // namespace penumbra::bench
