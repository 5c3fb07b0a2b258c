#pragma once

namespace penumbra::shadow {

// A batch of rays as structure of arrays, aligned to 64 bytes, with room for a multiple of 16. A
// ray is origin + t * direction, near < t < far.
struct RayStream {
    float* origin[3];
    float* direction[3];
    float* near_limit;
    float* far_limit;  // becomes -infinity where the ray is blocked
    int count = 0;
};

}  // namespace penumbra::shadow
