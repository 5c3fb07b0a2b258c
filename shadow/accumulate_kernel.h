#pragma once

#include "core/frame/light_sums.h"
#include "shadow/rays.h"

namespace penumbra {

namespace avx2 {
void accumulate_rays(const shadow::RayScratch& scratch, const LightSumsView& sums);
}
namespace avx512 {
void accumulate_rays(const shadow::RayScratch& scratch, const LightSumsView& sums);
}

}  // namespace penumbra
