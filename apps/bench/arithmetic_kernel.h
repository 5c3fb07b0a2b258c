#pragma once

// Fused multiply-adds as fast as one core executes them. A round is multiply_adds_per_round() of
// them, all lanes counted; the result depends on all rounds, so that none can be left out.

namespace penumbra::avx2 {
float multiply_adds(long long rounds, float seed);
int multiply_adds_per_round();
}  // namespace penumbra::avx2

namespace penumbra::avx512 {
float multiply_adds(long long rounds, float seed);
int multiply_adds_per_round();
}  // namespace penumbra::avx512
