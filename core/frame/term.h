#pragma once

#include "core/image/plane.h"

namespace penumbra {

// What is filtered, and divided, as one: the light of a group, which may be all of it, a lobe, or a
// light. A frame's radiance is the emission and what the estimator makes of each of its terms.
template <class T>
struct TermViews {
    PlaneView3<T> unshadowed;          // U
    PlaneView3<T> shadowed;            // S_N
    PlaneView3<T> unshadowed_samples;  // U_N, of the same samples
    PlaneView<T> noise;                // E in [0, 1], which drives the filter
};
using TermView = TermViews<float>;
using ConstTermView = TermViews<const float>;

// A term's full-frame planes.
struct Term {
    Plane3<float> unshadowed, shadowed, unshadowed_samples;
    Plane<float> noise;

    // For AOVs, empty where they are not wanted.
    Plane3<float> ratio;                                           // W
    Plane3<float> filtered_shadowed, filtered_unshadowed_samples;  // S_N and U_N after the filter
};

inline TermView view(Term& term) {
    return {.unshadowed = view(term.unshadowed),
            .shadowed = view(term.shadowed),
            .unshadowed_samples = view(term.unshadowed_samples),
            .noise = term.noise.view()};
}
inline ConstTermView view(const Term& term) {
    return {.unshadowed = view(term.unshadowed),
            .shadowed = view(term.shadowed),
            .unshadowed_samples = view(term.unshadowed_samples),
            .noise = term.noise.view()};
}

}  // namespace penumbra
