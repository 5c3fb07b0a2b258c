#pragma once

#include <cstdint>

namespace penumbra::profile {

// What bounds a pass from below. The benchmark measures each in the same run, in turns with the
// frames.
enum class LimitKind {
    kNone,
    kPrimaryRays,  // bare Embree finds the nearest triangle of every pixel
    kShadowRays,   // bare Embree on exactly the frame's shadow rays
    kStream,       // a triad a = b + s c over as many bytes as the pass must move at least
    kArithmetic,   // fused multiply-adds, as many as the pass must execute at least
    kSum,          // of the whole frame: its passes' limits, one after the other
};

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
