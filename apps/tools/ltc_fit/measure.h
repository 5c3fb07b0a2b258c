#pragma once

#include <algorithm>

#include "apps/tools/ltc_fit/polygons.h"
#include "core/light/ltc_table.h"

// How well the table serves a renderer: every number is taken after the float bilinear lookup.

namespace penumbra::ltc_fit {

struct MeanAndMaximum {
    double sum = 0;
    double maximum = 0;
    int count = 0;

    void add(double value) {
        sum += value;
        maximum = std::max(maximum, value);
        ++count;
    }
    [[nodiscard]] double mean() const { return count > 0 ? sum / count : 0; }
};

// Distances between a lobe (BRDF times cosine at F = 1) and what the table makes of it, above the
// horizon.
struct LobeErrors {
    double relative_l1;  // integral of |difference| over the albedo
    double relative_l2;  // roots of the integrals of squares, likewise
    double albedo;       // absolute
    double fresnel;      // absolute
};

inline LobeErrors lobe_errors_on(const LtcEntry<float>& entry, const LobeConfiguration& lobe,
                                 int resolution) {
    const LtcEntry<double> exact{entry.m00, entry.m02, entry.m22, entry.norm, entry.fresnel};
    const std::vector<LobePoint> points = lobe_points(lobe, resolution);
    double absolute = 0;
    double squared = 0;
    double value_squared = 0;
    for (const LobePoint& point : points) {
        if (point.direction.z <= 0) continue;
        const double difference = exact.norm * ltc_density(exact, point.direction) - point.value;
        absolute += std::abs(difference) * point.solid_angle;
        squared += difference * difference * point.solid_angle;
        value_squared += point.value * point.value * point.solid_angle;
    }
    const Albedo albedo = sum_albedo(points);
    return {absolute / albedo.norm, std::sqrt(squared / value_squared),
            std::abs(exact.norm - albedo.norm), std::abs(exact.fresnel - albedo.fresnel)};
}

// The grid is doubled until the distances change by less than `tolerance`.
inline LobeErrors lobe_errors(const float* table, const LobeConfiguration& lobe,
                              double tolerance = 1e-4) {
    const LtcEntry<float> entry =
        ltc_lookup(static_cast<float>(lobe.roughness), static_cast<float>(lobe.cos_view), table);
    LobeErrors coarse = lobe_errors_on(entry, lobe, 64);
    for (int resolution = 128; resolution <= 1024; resolution *= 2) {
        const LobeErrors fine = lobe_errors_on(entry, lobe, resolution);
        const double change = std::max({std::abs(fine.relative_l1 - coarse.relative_l1),
                                        std::abs(fine.relative_l2 - coarse.relative_l2),
                                        std::abs(fine.albedo - coarse.albedo)});
        coarse = fine;
        if (change < tolerance) break;
    }
    return coarse;
}

struct TableErrors {
    MeanAndMaximum relative_l1, relative_l2, albedo, fresnel;
};

// Over roughness 0.05, 0.10 ... 1.00 and the angles 0, 5, ... 80, 84, 87, 89 degrees, up to
// `largest_degrees`.
inline TableErrors table_errors(const float* table, double largest_degrees = 90,
                                double tolerance = 1e-4) {
    TableErrors errors;
    for (int step = 1; step <= 20; ++step) {
        for (const double degrees :
             {0, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65, 70, 75, 80, 84, 87, 89}) {
            if (degrees > largest_degrees) continue;
            const double cos_view = std::cos(degrees * std::numbers::pi / 180);
            const LobeErrors lobe = lobe_errors(table, {0.05 * step, cos_view}, tolerance);
            errors.relative_l1.add(lobe.relative_l1);
            errors.relative_l2.add(lobe.relative_l2);
            errors.albedo.add(lobe.albedo);
            errors.fresnel.add(lobe.fresnel);
        }
    }
    return errors;
}

// |radiance by the table alone - radiance by cubature| of random lights of radiance 1 at F = 1.
inline MeanAndMaximum polygon_errors(const float* table, int first, int last, int resolution) {
    MeanAndMaximum errors;
    for (int number = first; number < last; ++number) {
        const LightCase light_case = random_light(number);
        const LtcEntry<float> entry =
            ltc_lookup(static_cast<float>(light_case.lobe.roughness),
                       static_cast<float>(light_case.lobe.cos_view), table);
        errors.add(std::abs(radiance_by_table(entry, light_case.light) -
                            radiance_by_cubature(light_case, resolution).norm));
    }
    return errors;
}

}  // namespace penumbra::ltc_fit
