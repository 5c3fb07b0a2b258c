#!/usr/bin/env bash
# Usage: sources_selftest.sh: shows that sources.sh finds what it forbids, on small made-up trees.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

passed=0
failed=0

# expect VERDICT FILE TEXT: the check of a tree with only this file (and a kernel) gives this verdict.
expect() {
    local verdict=passes
    rm -rf "${tree:?}"/*
    mkdir -p "$tree/core/simd" "$tree/$(dirname "$2")"
    printf 'cmake_minimum_required(VERSION 3.25)\n' >"$tree/CMakeLists.txt"
    printf '#include "core/formula.h"\n' >"$tree/core/base_kernel.cpp"
    printf '%s\n' "$3" >"$tree/$2"
    "$here/sources.sh" "$tree" >/dev/null || verdict=fails
    if [ "$verdict" = "$1" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "expected that the check $1 with $2 holding: $3"
    fi
}

expect passes core/formula.h 'F y = simd::sqrt(x);  // not std::sqrt'
expect passes core/other.h 'const double y = std::sqrt(x);'
expect fails core/formula.h 'const float y = std::sqrt(x);'
expect fails core/formula.h 'const float y = sqrtf(x);'
expect fails core/formula.h 'const float y = __builtin_fmaf(x, x, x);'
expect fails core/other_kernel.cpp 'std::vector<float> rows;'
expect fails core/other_kernel.cpp 'float* p = new float[4];'
expect fails core/math.cpp 'y = xsimd::sqrt(x);'
expect passes core/simd/lanes.h 'return xsimd::sqrt(x);'
expect fails core/any.cpp 'y = _mm256_rcp_ps(x);'
expect fails core/any.cpp 'y = _mm512_rsqrt14_ps(x);'
expect fails core/any.cpp '#include "raster/setup.h"'
expect fails raster/any.cpp '#include "shadow/sums.h"'
expect fails denoise/any.h '#include "raster/setup.h"'
expect passes apps/renderer/any.cpp '#include "raster/setup.h"'
expect passes core/scene/any.h '#include "core/frame/camera.h"'
expect fails core/frame/any.h '#include "core/scene/scene.h"'
expect fails core/simd/any.cpp '#include "core/math/vec.h"'
expect fails core/any.h '#include "core/simd/lanes.h"'
expect fails core/unordered/any.h 'int x;'
expect fails raster/any.cpp '#include <embree3/rtcore.h>'
expect passes shadow/embree.h '#include <embree3/rtcore.h>'
expect fails shadow/any.cpp '#include <embree3/rtcore.h>'
expect fails tests/any.cpp '#if RTC_VERSION_MAJOR >= 4'
expect fails shadow/any.cpp 'rtcOccluded1(scene, &ray, &arguments);'
expect fails apps/any.cpp '#include <tbb/parallel_for.h>'
expect fails core/image/any.h '#include <ImfHeader.h>'
expect fails CMakeLists.txt 'add_compile_options(-ffast-math)'

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
