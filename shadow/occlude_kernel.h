#pragma once

#include "shadow/ray_stream.h"
#include "shadow/triangle_tree.h"

namespace penumbra {

// Marks the rays that a triangle of the tree blocks. 0 <= near <= far <= 2^20.
namespace avx2 {
void occlude(shadow::TreeReference tree, const shadow::RayStream& rays);
}
namespace avx512 {
void occlude(shadow::TreeReference tree, const shadow::RayStream& rays);
}

}  // namespace penumbra
