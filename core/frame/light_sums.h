#pragma once

#include "core/frame/tile.h"

namespace penumbra {

// What lighting leaves behind, per pixel and channel. U is analytic; S_N and U_N are sums over the
// same samples with and without visibility: with visibility 1 they are the same floats.
template <class T>
struct LightSumViews {
    PlaneView3<T> unshadowed_diffuse;  // U of the diffuse lobe, summed over the lights: radiance
    PlaneView3<T> unshadowed_glossy;   // U of the specular lobe
    PlaneView3<T> shadowed;  // S_N, mean over the samples of a light, summed over the lights
    PlaneView3<T> unshadowed_samples;  // U_N, likewise
};
using LightSumsView = LightSumViews<float>;
using ConstLightSumsView = LightSumViews<const float>;

inline ConstLightSumsView to_const(const LightSumsView& s) {
    return {.unshadowed_diffuse = to_const(s.unshadowed_diffuse),
            .unshadowed_glossy = to_const(s.unshadowed_glossy),
            .shadowed = to_const(s.shadowed),
            .unshadowed_samples = to_const(s.unshadowed_samples)};
}

}  // namespace penumbra
