#include "core/profile/profile.h"

#include <algorithm>
#include <utility>

namespace penumbra::profile {

void Profile::make_tracks(int threads) {
    while (this->threads() < threads) tracks_.push_back(std::make_unique<Track>());
    make_room();
}

void Profile::make_room() {
    for (const std::unique_ptr<Track>& track : tracks_) {
        std::vector<Slice>& slices = track->slices_;
        const std::size_t wanted = std::min(slices.size() + room_, most_);
        // Twice as much, so that a long sequence does not copy its slices at every frame.
        if (slices.capacity() < wanted)
            slices.reserve(std::min(std::max(wanted, 2 * slices.capacity()), most_));
    }
}

void Profile::clear() {
    for (const std::unique_ptr<Track>& track : tracks_) {
        track->slices_.clear();
        track->dropped_ = 0;
    }
}

const char* Profile::enter(const char* phase) {
    return std::exchange(phase_, phase);
}

std::uint64_t Profile::dropped() const {
    std::uint64_t all = 0;
    for (const std::unique_ptr<Track>& track : tracks_) all += track->dropped();
    return all;
}

}  // namespace penumbra::profile
