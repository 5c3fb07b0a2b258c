#include "denoise/scratch.h"

#include <algorithm>

#include "denoise/joint_bilateral_kernel.h"
#include "denoise/noise_estimate_kernel.h"

namespace penumbra::denoise {

Scratch::Scratch(int window_width)
    : lines_(std::max(noise_scratch_size(), filter_scratch_size(window_width)) / kPerLine + 1) {}

}  // namespace penumbra::denoise
