#pragma once

#include <cstdint>

#include "apps/bench/report.h"
#include "core/simd/isa.h"
#include "shadow/trace_isa.h"

namespace penumbra::bench {

// What can be said about the machine without measuring.
[[nodiscard]] Machine describe_machine(simd::Isa kernels, shadow::TraceIsa trace);

// The largest resident size of this process since the last reset, in bytes. Where the system does
// not allow to reset it, since the process began.
[[nodiscard]] std::uint64_t peak_memory_bytes();
// Gives unused memory back and starts anew.
void reset_peak_memory();

// The number of threads to sweep over: powers of two up to `most`, and `most`.
[[nodiscard]] std::vector<int> thread_sweep(int most);

}  // namespace penumbra::bench
