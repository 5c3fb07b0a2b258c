#pragma once

// Loops that do nothing but arithmetic. Each result depends on all rounds, so that none can be left
// out.

namespace penumbra::avx2 {
// Fused multiply-adds as fast as one core executes them. A round is multiply_adds_per_round() of
// them, all lanes counted.
float multiply_adds(long long rounds, float seed);
int multiply_adds_per_round();
// Each waits for the one before it: most of the core is idle.
float dependent_multiply_adds(int count, float seed);
// Sums of a table in the first-level cache, as fast as the core loads and adds: little of it is
// idle. `floats` is a multiple of 128.
float table_sums(const float* table, int floats, int rounds);
}  // namespace penumbra::avx2

namespace penumbra::avx512 {
float multiply_adds(long long rounds, float seed);
int multiply_adds_per_round();
float dependent_multiply_adds(int count, float seed);
float table_sums(const float* table, int floats, int rounds);
}  // namespace penumbra::avx512
