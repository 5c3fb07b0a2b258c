#include "shadow/accumulate.h"

#include "shadow/accumulate_kernel.h"

namespace penumbra::shadow {

void accumulate(const RayScratch& scratch, simd::Isa isa, const LightSumsView& sums) {
    simd::pick(isa, &avx2::accumulate_rays, &avx512::accumulate_rays)(scratch, sums);
}

}  // namespace penumbra::shadow
