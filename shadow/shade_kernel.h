#pragma once

#include <cstdint>

#include "core/frame/light_sums.h"
#include "core/frame/surface.h"
#include "core/light/light_set.h"
#include "core/light/lobe_accuracy.h"

namespace penumbra::shadow {

struct ShadeJob {
    LightSetView lights;
    const std::uint32_t* kept;
    int kept_count;
    Vec3f eye;
    LobeAccuracy accuracy;
    ConstSurfaceView surface;
    LightSumsView sums;
};

}  // namespace penumbra::shadow

namespace penumbra::avx2 {
void shade_tile(const shadow::ShadeJob& job);
}
namespace penumbra::avx512 {
void shade_tile(const shadow::ShadeJob& job);
}
