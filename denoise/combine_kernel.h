#pragma once

#include "denoise/combine.h"

namespace penumbra::avx2 {
void combine(const denoise::CombineInputs& inputs, const denoise::CombineOutputs& outputs,
             const PixelRect& elements);
}
namespace penumbra::avx512 {
void combine(const denoise::CombineInputs& inputs, const denoise::CombineOutputs& outputs,
             const PixelRect& elements);
}
