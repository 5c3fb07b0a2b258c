#pragma once

#include "core/simd/lanes.h"

namespace penumbra::compare {

// Wang et al. (2004), equation 13, from the local means, variances and covariance; peak 1.
template <class F>
F ssim_index(F mean_a, F mean_b, F variance_a, F variance_b, F covariance) {
    const F c1(0.01f * 0.01f), c2(0.03f * 0.03f);
    const F likeness = (F(2) * (mean_a * mean_b) + c1) * (F(2) * covariance + c2);
    const F size = (mean_a * mean_a + mean_b * mean_b + c1) * (variance_a + variance_b + c2);
    return likeness / size;
}

}  // namespace penumbra::compare
