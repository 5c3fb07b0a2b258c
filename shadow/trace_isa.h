#pragma once

#include <string_view>

namespace penumbra::shadow {

// Embree's own instruction set. Fixed, since about one occluded bit in a million may differ between
// them.
enum class TraceIsa { kAvx2, kAvx512, kAuto };

// "avx2", "avx512" or "auto"; throws InputError for other names and for what the processor lacks.
[[nodiscard]] TraceIsa parse_trace_isa(std::string_view name);
[[nodiscard]] std::string_view name(TraceIsa isa);

}  // namespace penumbra::shadow
