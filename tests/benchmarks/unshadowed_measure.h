#pragma once

#include <string>
#include <vector>

#include "core/image/png.h"
#include "core/scene/scene.h"
#include "tests/renderer/unshadowed_frame.h"

// How far the analytic U of a frame is from its U_N, of which there are two independent halves A
// and B. The reference M is their mean; (A - B) / 2 is as noisy as M and holds no U: it tells how
// much of a difference is the reference's own.

namespace penumbra::tests {

// A share of the lit pixels (those with a U or a U_N).
struct Group {
    std::string name;
    double pixels = 0;
    double error = 0;     // sum over pixels and channels of U - M
    double squared = 0;   // of (U - M)^2
    double noise = 0;     // of ((A - B) / 2)^2
    double variance = 0;  // of `squared - noise`, made by the noise

    // Per pixel and channel, the reference's variance taken away. 0 where there are no pixels.
    [[nodiscard]] double mean() const;
    [[nodiscard]] double rmse() const;
    [[nodiscard]] double rmse_at_most() const;  // two standard errors above
    [[nodiscard]] double noise_rms() const;
};

// FLIP of pictures at one exposure, mean over the frame, as the metric `flip` of penumbra diff.
struct FlipErrors {
    double exposure_ev = 0;
    double test = 0;    // U against M
    double noise = 0;   // A against M: what M's own noise makes
    double halves = 0;  // A against B
    // What is left without the reference's noise lies between these: errors add up at most, and at
    // least in squares.
    [[nodiscard]] double at_least() const;
    [[nodiscard]] double at_most() const;
};

struct UnshadowedErrors {
    double pixels = 0;    // of the frame
    double radiance = 0;  // mean of M over lit pixels and channels
    Group all;
    double noise_of_mean = 0;                     // |mean of (A - B) / 2|
    double relative_99 = 0;                       // 99th percentile of |U - M| / M of a lit pixel
    double noise_relative_99 = 0;                 // of |A - B| / 2M
    std::vector<Group> by_cos_view, by_material;  // the latter by falling squared error
    FlipErrors flip;
};

// `frame` has two batches.
[[nodiscard]] UnshadowedErrors measure_unshadowed(const UnshadowedFrame& frame, const Scene& scene);

// M.
[[nodiscard]] Plane3<float> mean_of_halves(const UnshadowedFrame& frame);

// (U - M) / M: +10 % and more is red, 0 white, -10 % and less blue; grey where there is no light.
[[nodiscard]] image::Picture relative_error_picture(const UnshadowedFrame& frame);

}  // namespace penumbra::tests
