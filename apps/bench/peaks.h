#pragma once

#include <cstdint>
#include <vector>

#include "core/parallel/arena.h"
#include "core/simd/isa.h"

// What the machine's memory and arithmetic units reach: loops that do nothing else.

namespace penumbra::bench {

// Stores that go around the caches save reading what they overwrite, but only pay where the arrays
// do not fit into them.
enum class StreamStores { kThroughCaches, kAroundCaches };

// The triad a = b + s c (McCalpin, "Memory Bandwidth and Machine Balance in Current High
// Performance Computers", 1995) over arrays of `bytes` / 3 each: two are read, one is written.
class Triad {
  public:
    explicit Triad(std::uint64_t bytes);
    // All of it once, in parallel.
    void run(const parallel::Arena& arena, StreamStores stores);

  private:
    void chunk(int index, StreamStores stores);

    std::size_t blocks_;  // of 16 floats in each array
    std::vector<float> memory_;
    float* arrays_[3];
};

// At least `count` fused multiply-adds of single floats (lanes), in parallel.
void multiply_adds(std::uint64_t count, simd::Isa isa, const parallel::Arena& arena);

}  // namespace penumbra::bench
