#pragma once

#include "core/image/plane.h"
#include "core/math/vec.h"

// Vectors of lanes from and to three planes: as many pixels of a row as F has lanes, from (x, y)
// on.

namespace penumbra {

template <class F>
Vec3<F> load3(const PlaneView3<const float>& planes, int x, int y) {
    return {simd::load<F>(planes[0].row(y) + x), simd::load<F>(planes[1].row(y) + x),
            simd::load<F>(planes[2].row(y) + x)};
}

// The same from three addresses, each `offset` elements on.
template <class F>
Vec3<F> load3(const float* const* planes, std::ptrdiff_t offset) {
    return {simd::load<F>(planes[0] + offset), simd::load<F>(planes[1] + offset),
            simd::load<F>(planes[2] + offset)};
}

// `planes` are a PlaneView3<float> or a Plane3<float>.
template <class Planes, class F>
void store3(Planes& planes, int x, int y, const Vec3<F>& value) {
    simd::store(planes[0].row(y) + x, value.x);
    simd::store(planes[1].row(y) + x, value.y);
    simd::store(planes[2].row(y) + x, value.z);
}

}  // namespace penumbra
