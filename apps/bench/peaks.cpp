#include "apps/bench/peaks.h"

#include <xmmintrin.h>

#include <algorithm>
#include <atomic>
#include <bit>

#include "apps/bench/arithmetic_kernel.h"

namespace penumbra::bench {
namespace {

constexpr std::size_t kBlock = 16;          // floats: a cache line
constexpr std::size_t kChunkBlocks = 4096;  // 256 KiB of each array are a task
constexpr int kArithmeticTasks = 64;        // enough to balance, each long enough to measure

float* aligned(float* pointer) {
    const auto address = std::bit_cast<std::uintptr_t>(pointer);
    return pointer + (64 - address % 64) % 64 / sizeof(float);
}

template <class Store>
void triad(const float* b, const float* c, std::size_t floats, const Store& store) {
    const __m128 scale = _mm_set1_ps(3.0f);
    for (std::size_t i = 0; i < floats; i += 4)
        store(i, _mm_add_ps(_mm_load_ps(b + i), _mm_mul_ps(scale, _mm_load_ps(c + i))));
}

}  // namespace

Triad::Triad(std::uint64_t bytes)
    : blocks_(std::max<std::uint64_t>(bytes / (3 * kBlock * sizeof(float)), 1)),
      memory_((3 * blocks_ + 1) * kBlock, 1.0f) {
    for (std::size_t i = 0; i < 3; ++i) arrays_[i] = aligned(memory_.data()) + i * blocks_ * kBlock;
}

void Triad::chunk(int index, StreamStores stores) {
    const std::size_t first = static_cast<std::size_t>(index) * kChunkBlocks;
    const std::size_t count = std::min(kChunkBlocks, blocks_ - first) * kBlock;
    float* const a = arrays_[0] + first * kBlock;
    const float* const b = arrays_[1] + first * kBlock;
    const float* const c = arrays_[2] + first * kBlock;
    if (stores == StreamStores::kAroundCaches) {
        triad(b, c, count, [a](std::size_t i, __m128 value) { _mm_stream_ps(a + i, value); });
        _mm_sfence();
    } else {
        triad(b, c, count, [a](std::size_t i, __m128 value) { _mm_store_ps(a + i, value); });
    }
}

void Triad::run(const parallel::Arena& arena, StreamStores stores) {
    const std::size_t chunks = (blocks_ + kChunkBlocks - 1) / kChunkBlocks;
    arena.for_each(static_cast<int>(chunks), [&](int index, int) { chunk(index, stores); });
}

void multiply_adds(std::uint64_t count, simd::Isa isa, const parallel::Arena& arena) {
    const auto kernel = simd::pick(isa, &avx2::multiply_adds, &avx512::multiply_adds);
    const int per_round =
        simd::pick(isa, &avx2::multiply_adds_per_round, &avx512::multiply_adds_per_round)();
    const std::uint64_t per_task = static_cast<std::uint64_t>(per_round) * kArithmeticTasks;
    const auto rounds = static_cast<long long>((count + per_task - 1) / per_task);
    std::atomic<float> kept = 0;  // so that no compiler finds the loops useless
    arena.for_each(kArithmeticTasks, [&](int index, int) {
        kept.store(kernel(rounds, static_cast<float>(index)), std::memory_order_relaxed);
    });
}

}  // namespace penumbra::bench
