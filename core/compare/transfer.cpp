#include "core/compare/transfer.h"

#include "core/compare/transfer_kernel.h"
#include "core/simd/isa.h"

namespace penumbra::compare {
namespace {

auto row_function(Transfer curve) {
    const simd::Isa isa = simd::best_isa();
    if (curve == Transfer::kClamp) return simd::pick(isa, &avx2::clamp_row, &avx512::clamp_row);
    if (curve == Transfer::kEncodeSrgb)
        return simd::pick(isa, &avx2::encode_srgb_row, &avx512::encode_srgb_row);
    return simd::pick(isa, &avx2::decode_srgb_row, &avx512::decode_srgb_row);
}

}  // namespace

Plane3<float> transfer(const Plane3<float>& from, Transfer curve, const Extent& extent) {
    const auto row = row_function(curve);
    Plane3<float> to = {make_region(extent), make_region(extent), make_region(extent)};
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (int y = 0; y < extent.padded_height(); ++y)
            row(from[channel].row(y), to[channel].row(y), extent.padded_width());
    return to;
}

}  // namespace penumbra::compare
