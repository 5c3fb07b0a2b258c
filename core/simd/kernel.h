#pragma once

#include "core/simd/lanes.h"

// For *_kernel.cpp only: the lane types of the instruction set this unit is compiled for. The build
// defines PENUMBRA_ISA as `avx2` or `avx512`; kernels put their entry points in
// penumbra::PENUMBRA_ISA.

namespace penumbra::avx2 {
using LaneIsa = simd::Avx2;
}
namespace penumbra::avx512 {
using LaneIsa = simd::Avx512;
}
namespace penumbra::PENUMBRA_ISA {
using F = simd::Float<LaneIsa>;
using I = simd::Integer<LaneIsa, std::int32_t>;
using U = simd::Integer<LaneIsa, std::uint32_t>;
using M = simd::Mask<LaneIsa>;
inline constexpr int kLanes = LaneIsa::kLanes;
}  // namespace penumbra::PENUMBRA_ISA
