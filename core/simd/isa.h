#pragma once

#include <string_view>

namespace penumbra::simd {

// The instruction sets that kernels are compiled for. The choice changes no bit of any image.
enum class Isa { kAvx2, kAvx512 };

// Can this processor run kernels of this instruction set?
[[nodiscard]] bool is_supported(Isa isa);

// The widest supported one. Throws InputError on a processor without AVX2 and FMA.
[[nodiscard]] Isa best_isa();

[[nodiscard]] std::string_view name(Isa isa);

// Picks one of two functions of the same type: pick(isa, &avx2::resolve, &avx512::resolve)(...).
template <class Function>
[[nodiscard]] Function* pick(Isa isa, Function* avx2, Function* avx512) {
    return isa == Isa::kAvx512 ? avx512 : avx2;
}

}  // namespace penumbra::simd
