#include "apps/bench/floors.h"

#include <algorithm>

namespace penumbra::bench {

using profile::Kind;
using profile::Slice;

Floors::Times Floors::times(const profile::Profile& profile) {
    Times sums;
    std::map<std::string_view, profile::Nanoseconds> loops;
    for (int worker = 0; worker < profile.threads(); ++worker)
        for (const Slice& slice : profile.track(worker).slices()) {
            const profile::Nanoseconds time = slice.end - slice.begin;
            if (slice.kind == Kind::kLoop)
                loops[slice.name] += time;
            else
                sums[{slice.kind, slice.name, slice.first.value, slice.second.value}] += time;
        }
    for (auto& [key, sum] : sums)
        if (key.kind == Kind::kPhase) sum -= loops[key.name];
    return sums;
}

void Floors::add(const profile::Profile& profile) {
    is_complete_ = is_complete_ && profile.dropped() == 0;
    for (const auto& [key, time] : times(profile)) {
        const auto [entry, is_new] = least_.try_emplace(key, time);
        if (!is_new) entry->second = std::min(entry->second, time);
    }
}

double Floors::milliseconds(Kind kind, std::string_view name) const {
    if (!is_complete_) return 0;
    profile::Nanoseconds sum = 0;
    for (const auto& [key, time] : least_)
        if (key.kind == kind && key.name == name) sum += time;
    return 1e-6 * static_cast<double>(sum);
}

}  // namespace penumbra::bench
