#pragma once

#include <cstdint>

namespace penumbra::profile {

// What a pass did, in the units its throughput is told in. Bytes are those that must cross the
// memory bus at least, if the caches are perfect and the picture does not fit into them.
struct Work {
    std::uint64_t pixels = 0;
    std::uint64_t triangles = 0;
    std::uint64_t rays = 0;
    std::uint64_t bytes = 0;

    Work& operator+=(const Work& other) {
        pixels += other.pixels;
        triangles += other.triangles;
        rays += other.rays;
        bytes += other.bytes;
        return *this;
    }
    friend bool operator==(const Work&, const Work&) = default;
};

}  // namespace penumbra::profile
