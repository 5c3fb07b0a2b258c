#include "core/simd/isa.h"

#include "core/error.h"

namespace penumbra::simd {

bool is_supported(Isa isa) {
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                      __builtin_cpu_supports("bmi2");
    if (isa == Isa::kAvx2) return avx2;
    return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512vl");
}

Isa best_isa() {
    if (is_supported(Isa::kAvx512)) return Isa::kAvx512;
    if (is_supported(Isa::kAvx2)) return Isa::kAvx2;
    throw InputError(
        "this processor has neither AVX2 with FMA nor AVX-512; penumbra needs one of them");
}

std::string_view name(Isa isa) {
    return isa == Isa::kAvx512 ? "avx512" : "avx2";
}

}  // namespace penumbra::simd
