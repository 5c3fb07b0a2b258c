#include "shadow/trace_isa.h"

#include "core/error.h"
#include "core/simd/isa.h"

namespace penumbra::shadow {

std::string_view name(TraceIsa isa) {
    switch (isa) {
        case TraceIsa::kAvx2:
            return "avx2";
        case TraceIsa::kAvx512:
            return "avx512";
        case TraceIsa::kAuto:
            return "auto";
    }
    return "";
}

TraceIsa parse_trace_isa(std::string_view name) {
    if (name == "auto") return TraceIsa::kAuto;
    const bool avx512 = name == "avx512";
    if (!avx512 && name != "avx2")
        throw InputError(fmt::format("trace isa: expected avx2, avx512 or auto, got \"{}\"", name));
    if (!simd::is_supported(avx512 ? simd::Isa::kAvx512 : simd::Isa::kAvx2))
        throw InputError(fmt::format("trace isa: this processor has no {}", name));
    return avx512 ? TraceIsa::kAvx512 : TraceIsa::kAvx2;
}

}  // namespace penumbra::shadow
