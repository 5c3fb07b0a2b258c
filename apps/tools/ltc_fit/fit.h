#pragma once

#include <array>

#include "apps/tools/ltc_fit/lobe.h"

// Fits the three free entries of the inverse matrix to a GGX lobe by weighted least squares.

namespace penumbra::ltc_fit {

// The inverse matrix in the terms of a fit. `tilt` is the angle of the lobe's ridge from the
// normal, away from the view. The first row of the matrix is stretch * (cos tilt, 0, sin tilt),
// which is 0 on the ridge; the second (0, 1, 0); the third alpha * lift * (0, 0, 1), so that the
// horizon stays where it is. The determinant is alpha * stretch * lift * cos tilt.
struct LtcShape {
    double stretch, tilt, lift;
};

struct InverseMatrix {
    double m00, m02, m22;

    [[nodiscard]] double determinant() const { return m00 * m22; }
    [[nodiscard]] double density(const Vec3d& direction) const {
        const double x = m00 * direction.x + m02 * direction.z;
        const double z = m22 * direction.z;
        const double squared = x * x + direction.y * direction.y + z * z;
        return std::max(z, 0.0) * determinant() / (std::numbers::pi * squared * squared);
    }
};

inline InverseMatrix inverse_matrix(const LtcShape& shape, double alpha) {
    return {shape.stretch * std::cos(shape.tilt), shape.stretch * std::sin(shape.tilt),
            alpha * shape.lift};
}

// A good start for every lobe: exact for narrow ones away from grazing.
inline LtcShape initial_shape(const LobeConfiguration& lobe) {
    const double cosine = std::max(lobe.cos_view, lobe.alpha());
    return {cosine, std::acos(cosine), 2};
}

struct FitSettings {
    int resolution = 144;
    // A residual counts as much as (value / peak + floor)^-flattening: flattening 0 is least
    // squares, which sees little but the peak; 1 with a small floor bounds the L1 distance, but
    // loses the peak. Of those tried these give about the least L1 distance and radiance error of
    // polygons at an L2 distance 10 % above the least.
    double flattening = 0.7;
    double floor = 0.1;
    int iterations = 40;
};

inline constexpr std::size_t kParameters = 3;
using Parameters = std::array<double, kParameters>;
using NormalMatrix = std::array<Parameters, kParameters>;

// The weighted problem: targets (the lobe divided by its albedo) and square roots of the weights.
class FitProblem {
  public:
    FitProblem(const LobeConfiguration& lobe, const FitSettings& settings)
        : alpha_(lobe.alpha()), points_(lobe_points(lobe, settings.resolution)) {
        const Albedo albedo = sum_albedo(points_);
        double peak = 0;
        for (LobePoint& point : points_) peak = std::max(peak, point.value /= albedo.norm);
        for (const LobePoint& point : points_)
            weights_.push_back(std::sqrt(
                point.solid_angle *
                std::pow(point.value / peak + settings.floor, -settings.flattening) / peak));
    }

    // The logarithms keep stretch and lift positive, the tangent keeps the tilt below 90 degrees:
    // together, the determinant positive.
    [[nodiscard]] static Parameters to_parameters(const LtcShape& shape) {
        return {std::log(shape.stretch), std::tan(shape.tilt), std::log(shape.lift)};
    }
    [[nodiscard]] static LtcShape to_shape(const Parameters& p) {
        return {std::exp(p[0]), std::atan(p[1]), std::exp(p[2])};
    }

    // Weighted differences of target and distribution.
    void residuals(const Parameters& parameters, std::vector<double>& result) const {
        const InverseMatrix matrix = inverse_matrix(to_shape(parameters), alpha_);
        result.resize(points_.size());
        for (std::size_t i = 0; i < points_.size(); ++i)
            result[i] = weights_[i] * (matrix.density(points_[i].direction) - points_[i].value);
    }

    [[nodiscard]] double cost(const Parameters& parameters, std::vector<double>& scratch) const {
        residuals(parameters, scratch);
        double sum = 0;
        for (const double residual : scratch) sum += residual * residual;
        return sum;
    }

    // The Gauss-Newton system at `parameters`, by central differences.
    void linearize(const Parameters& parameters, NormalMatrix& normal, Parameters& gradient) const {
        std::vector<double> base;
        std::array<std::vector<double>, kParameters> column;
        residuals(parameters, base);
        for (std::size_t k = 0; k < kParameters; ++k) column[k] = derivative(parameters, k);
        for (std::size_t a = 0; a < kParameters; ++a) {
            gradient[a] = inner_product(column[a], base);
            for (std::size_t b = 0; b < kParameters; ++b)
                normal[a][b] = inner_product(column[a], column[b]);
        }
    }

  private:
    [[nodiscard]] std::vector<double> derivative(const Parameters& at, std::size_t k) const {
        constexpr double kStep = 1e-5;
        Parameters up = at;
        Parameters down = at;
        up[k] += kStep;
        down[k] -= kStep;
        std::vector<double> result;
        std::vector<double> below;
        residuals(up, result);
        residuals(down, below);
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i] = (result[i] - below[i]) / (2 * kStep);
        return result;
    }
    [[nodiscard]] static double inner_product(const std::vector<double>& a,
                                              const std::vector<double>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
        return sum;
    }

    double alpha_;
    std::vector<LobePoint> points_;
    std::vector<double> weights_;
};

// Solves a symmetric positive definite system by elimination.
inline Parameters solve(NormalMatrix matrix, Parameters right) {
    for (std::size_t pivot = 0; pivot < kParameters; ++pivot) {
        for (std::size_t row = pivot + 1; row < kParameters; ++row) {
            const double factor = matrix[row][pivot] / matrix[pivot][pivot];
            for (std::size_t k = pivot; k < kParameters; ++k)
                matrix[row][k] -= factor * matrix[pivot][k];
            right[row] -= factor * right[pivot];
        }
    }
    for (std::size_t row = kParameters; row-- > 0;) {
        for (std::size_t k = row + 1; k < kParameters; ++k) right[row] -= matrix[row][k] * right[k];
        right[row] /= matrix[row][row];
    }
    return right;
}

// Levenberg-Marquardt with Marquardt's scaled damping, from `start`.
struct Fit {
    LtcShape shape;
    double cost;
};

inline Fit minimize(const FitProblem& problem, const LtcShape& start, int iterations) {
    std::vector<double> scratch;
    Parameters parameters = FitProblem::to_parameters(start);
    double cost = problem.cost(parameters, scratch);
    double damping = 1e-3;
    for (int iteration = 0; iteration < iterations; ++iteration) {
        NormalMatrix normal{};
        Parameters gradient{};
        problem.linearize(parameters, normal, gradient);
        for (std::size_t k = 0; k < kParameters; ++k) normal[k][k] *= 1 + damping;
        const Parameters step = solve(normal, gradient);
        Parameters trial{};
        for (std::size_t k = 0; k < kParameters; ++k) trial[k] = parameters[k] - step[k];
        const double trial_cost = problem.cost(trial, scratch);
        const bool improves = trial_cost < cost;
        damping *= improves ? 0.2 : 8;
        if (!improves && damping > 1e8) break;
        if (!improves) continue;
        const double gain = (cost - trial_cost) / cost;
        parameters = trial;
        cost = trial_cost;
        if (gain < 1e-12) break;
    }
    return {FitProblem::to_shape(parameters), cost};
}

// From each of the starts; the best result.
inline LtcShape fit_shape(const LobeConfiguration& lobe, const std::vector<LtcShape>& starts,
                          const FitSettings& settings = {}) {
    const FitProblem problem(lobe, settings);
    Fit best{{}, HUGE_VAL};
    for (const LtcShape& start : starts) {
        const Fit fit = minimize(problem, start, settings.iterations);
        if (fit.cost < best.cost) best = fit;
    }
    return best.shape;
}

}  // namespace penumbra::ltc_fit
