#pragma once

#include <vector>

#include "core/compare/separable.h"
#include "core/image/plane.h"

// FLIP: how different two pictures look when one flips between them. 0 is equal, 1 is black beside
// white. Papers in core/compare/flip_formula.h.

namespace penumbra::compare {

// A screen 3840 pixels and 0.7 m wide, seen from 0.7 m, as in the published tool.
inline constexpr double kPixelsPerDegree = 67.0206433;

// How far the filters reach: 3 standard deviations of the widest one.
inline constexpr int kFlipHalo = 10;

// The error in [0, 1] of each pixel of a region. Both pictures are linear RGB in [0, 1] on planes
// of make_region(extent) with extent.halo >= kFlipHalo; `errors` holds the region alone.
void flip_map(const Plane3<float>& reference, const Plane3<float>& test, const Extent& extent,
              Plane<float>& errors);

// The exposures of HDR-FLIP in EV, lowest first.
struct Exposures {
    double start = 0, stop = 0;
    int count = 2;
    [[nodiscard]] double ev(int index) const {
        return count < 2 ? start : start + (stop - start) * index / (count - 1);
    }
};

// From the reference's luminance: the brightest pixel and the (upper) median, exposed so that the
// tone curve shows each at 0.85 (2021, section 3.1). One exposure where both are equal; 0 EV for a
// black reference.
[[nodiscard]] Exposures choose_exposures(double median_luminance, double largest_luminance);

// The largest flip_map() over the exposures. The pictures are scene-linear; negative values count
// as 0.
void hdr_flip_map(const Plane3<float>& reference, const Plane3<float>& test,
                  const Exposures& exposures, const Extent& extent, Plane<float>& errors);

}  // namespace penumbra::compare
