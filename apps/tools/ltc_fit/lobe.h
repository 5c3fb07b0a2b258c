#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "core/bsdf/ggx.h"

// The GGX lobe that one entry of the table stands for, in double precision, as a set of quadrature
// points. The view is (sin, 0, cos), so the lobe is symmetric in y: points cover y > 0 and count
// twice.

namespace penumbra::ltc_fit {

struct LobeConfiguration {
    double roughness;
    double cos_view;

    [[nodiscard]] double alpha() const { return roughness * roughness; }
    [[nodiscard]] Vec3d view() const {
        return {std::sqrt((1 - cos_view) * (1 + cos_view)), 0, cos_view};
    }
};

// A direction, the lobe there (BRDF times cosine at F = 1; 0 below the horizon), Schlick's weight,
// and the solid angle that the direction stands for.
struct LobePoint {
    Vec3d direction;
    double value;
    double fresnel_weight;
    double solid_angle;
};

// The direction that the visible normal for (u, v) of the unit square mirrors the view to. Dupuy
// and Benyoub, "Sampling Visible GGX Normals with Spherical Caps" (2023); here v covers only y > 0.
inline Vec3d mirrored_direction(const LobeConfiguration& lobe, double u, double v) {
    const Vec3d view = lobe.view();
    const double alpha = lobe.alpha();
    const Vec3d stretched = normalize(Vec3d{alpha * view.x, 0, view.z});
    const double below_top = u * (1 + stretched.z);
    const double radius = std::sqrt(std::max(0.0, below_top * (2 - below_top)));
    const double azimuth = std::numbers::pi * v;
    const Vec3d cap{radius * std::cos(azimuth), radius * std::sin(azimuth), 1 - below_top};
    const Vec3d half = cap + stretched;
    const Vec3d normal = normalize(Vec3d{alpha * half.x, alpha * half.y, half.z});
    return normal * (2 * dot(view, normal)) - view;
}

// resolution^2 points at the middles of a grid over the visible normals. The grid is denser towards
// both ends of u, so that the tail of a narrow lobe is resolved and the midpoint rule has no error
// terms from the ends.
inline std::vector<LobePoint> lobe_points(const LobeConfiguration& lobe, int resolution) {
    std::vector<LobePoint> points;
    points.reserve(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution));
    for (int row = 0; row < resolution; ++row) {
        const double t = (row + 0.5) / resolution;
        const double u = t * t * t * (10 - t * (15 - 6 * t));
        const double stretch = 30 * t * t * (1 - t) * (1 - t);
        for (int column = 0; column < resolution; ++column) {
            const Vec3d direction = mirrored_direction(lobe, u, (column + 0.5) / resolution);
            const GgxLobe<double> ggx = ggx_evaluate(lobe.alpha(), lobe.view(), direction);
            const double share = stretch / (static_cast<double>(resolution) * resolution);
            points.push_back(
                {direction, ggx.brdf_times_cosine, ggx.fresnel_weight, share / ggx.density});
        }
    }
    return points;
}

// The albedo at F = 1 and the (1 - v.h)^5-weighted one.
struct Albedo {
    double norm;
    double fresnel;
};

inline Albedo sum_albedo(const std::vector<LobePoint>& points) {
    Albedo sum{0, 0};
    for (const LobePoint& point : points) {
        const double reflected = point.value * point.solid_angle;
        sum.norm += reflected;
        sum.fresnel += reflected * point.fresnel_weight;
    }
    return sum;
}

}  // namespace penumbra::ltc_fit
