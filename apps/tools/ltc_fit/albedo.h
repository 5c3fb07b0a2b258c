#pragma once

#include "apps/tools/ltc_fit/lobe.h"

// The albedo of a lobe to six digits. As a function of the visible normals the integrand has a kink
// where the mirrored direction meets the horizon: each meridian of normals is cut there, so that
// the rule of Gauss and Legendre sees smooth pieces only. Across the meridians the integrand is
// periodic, and the midpoint rule does as well.

namespace penumbra::ltc_fit {

struct GaussRule {
    std::vector<double> node, weight;  // on [0, 1]
};

// Newton's method on the Legendre polynomial, from Tricomi's approximate roots.
inline GaussRule gauss_legendre(int count) {
    GaussRule rule;
    for (int i = 0; i < count; ++i) {
        double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
        double slope = 1;
        for (int iteration = 0; iteration < 8; ++iteration) {
            double before = 1;
            double value = x;
            for (int k = 2; k <= count; ++k) {
                const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
                before = value;
                value = next;
            }
            slope = count * (x * value - before) / (x * x - 1);
            x -= value / slope;
        }
        rule.node.push_back(0.5 - 0.5 * x);
        rule.weight.push_back(1 / ((1 - x * x) * slope * slope));
    }
    return rule;
}

// A meridian of visible normals, run through by s in [0, 1] with u = 1 - (1 - s)^3: the far end,
// where a narrow lobe comes down to the horizon, is magnified.
class Meridian {
  public:
    Meridian(const LobeConfiguration& lobe, double v) : lobe_(lobe), v_(v) {}

    [[nodiscard]] Vec3d direction(double s) const {
        const double rest = 1 - s;
        return mirrored_direction(lobe_, 1 - rest * rest * rest, v_);
    }

    // Over [low, high], which lies on one side of the horizon.
    [[nodiscard]] Albedo integrate(double low, double high, const GaussRule& rule) const {
        Albedo sum{0, 0};
        for (std::size_t i = 0; i < rule.node.size(); ++i) {
            const double s = low + (high - low) * rule.node[i];
            const GgxLobe<double> ggx = ggx_evaluate(lobe_.alpha(), lobe_.view(), direction(s));
            if (ggx.density <= 0) continue;
            const double step = 3 * (1 - s) * (1 - s) * (high - low) * rule.weight[i];
            const double reflected = step * ggx.brdf_times_cosine / ggx.density;
            sum.norm += reflected;
            sum.fresnel += reflected * ggx.fresnel_weight;
        }
        return sum;
    }

    // Where the direction crosses the horizon between low and high.
    [[nodiscard]] double find_horizon(double low, double high) const {
        const bool begins_above = direction(low).z > 0;
        for (int step = 0; step < 50; ++step) {
            const double middle = 0.5 * (low + high);
            ((direction(middle).z > 0) == begins_above ? low : high) = middle;
        }
        return low;
    }

  private:
    LobeConfiguration lobe_;
    double v_;
};

// The pieces between crossings of the horizon; crossings are looked for in 16 intervals.
inline Albedo integrate_meridian(const Meridian& meridian, const GaussRule& rule) {
    constexpr int kIntervals = 16;
    Albedo sum{0, 0};
    double begin = 0;
    const auto add_up_to = [&](double end) {
        const Albedo piece = meridian.integrate(begin, end, rule);
        sum.norm += piece.norm;
        sum.fresnel += piece.fresnel;
        begin = end;
    };
    for (int i = 0; i < kIntervals; ++i) {
        const double low = static_cast<double>(i) / kIntervals;
        const double high = static_cast<double>(i + 1) / kIntervals;
        if ((meridian.direction(low).z > 0) != (meridian.direction(high).z > 0))
            add_up_to(meridian.find_horizon(low, high));
    }
    add_up_to(1);
    return sum;
}

inline Albedo integrate_albedo(const LobeConfiguration& lobe, int nodes, int meridians) {
    const GaussRule rule = gauss_legendre(nodes);
    Albedo sum{0, 0};
    for (int i = 0; i < meridians; ++i) {
        const Albedo part = integrate_meridian(Meridian(lobe, (i + 0.5) / meridians), rule);
        sum.norm += part.norm / meridians;
        sum.fresnel += part.fresnel / meridians;
    }
    return sum;
}

}  // namespace penumbra::ltc_fit
