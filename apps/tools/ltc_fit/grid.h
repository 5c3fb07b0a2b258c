#pragma once

#include <array>
#include <vector>

#include "apps/tools/ltc_fit/albedo.h"
#include "apps/tools/ltc_fit/fit.h"
#include "core/light/ltc_table.h"

// The nodes of the table and the fit of all of them.

namespace penumbra::ltc_fit {

inline double node_roughness(int index) {
    const double lowest = kMinimumRoughness;
    return lowest + (1 - lowest) * index / (kLtcRoughnessNodes - 1);
}

// The inverse of ltc_angle_coordinate.
inline double node_cos_view(int index) {
    if (index == kLtcAngleNodes - 1) return 0;
    const double x = static_cast<double>(index) / (kLtcAngleNodes - 1);
    const double tangent_like = kLtcGrazingStretch * x / (1 - x);
    return 1 / (1 + tangent_like * tangent_like);
}

// The shape of one lobe, carried to a neighbour in the way narrow lobes move.
inline LtcShape predict_shape(const LtcShape& from, const LobeConfiguration& there,
                              const LobeConfiguration& here) {
    const LtcShape narrow_there = initial_shape(there);
    const LtcShape narrow_here = initial_shape(here);
    return {from.stretch * narrow_here.stretch / narrow_there.stretch,
            std::min(from.tilt + narrow_here.tilt - narrow_there.tilt, 1.57), from.lift};
}

// At normal incidence the lobe is round, so only its width is free.
inline LtcShape fit_round_shape(const LobeConfiguration& lobe, const FitSettings& settings) {
    const LtcShape fitted = fit_shape(lobe, {initial_shape(lobe)}, settings);
    return {1, 0, fitted.lift / fitted.stretch};
}

// All angles of one roughness, from the normal to grazing, each started from its predecessor and
// from the shape of narrow lobes.
inline std::vector<LtcShape> fit_roughness(double roughness, const FitSettings& settings) {
    std::vector<LtcShape> shapes;
    shapes.reserve(kLtcAngleNodes);
    for (int angle = 0; angle < kLtcAngleNodes; ++angle) {
        const LobeConfiguration lobe{roughness, node_cos_view(angle)};
        if (angle == 0) {
            shapes.push_back(fit_round_shape(lobe, settings));
            continue;
        }
        const LobeConfiguration previous{roughness, node_cos_view(angle - 1)};
        const LtcShape& last = shapes.back();
        shapes.push_back(fit_shape(
            lobe, {last, predict_shape(last, previous, lobe), initial_shape(lobe)}, settings));
    }
    return shapes;
}

using TableRow = std::array<float, kLtcRowFloats>;

// One row of the table, as core/light/ltc_table.h describes it.
inline TableRow table_row(const LobeConfiguration& lobe, const LtcShape& shape) {
    // 48 nodes on each of 512 meridians: within 1e-6 of finer rules over the whole table.
    const Albedo albedo = integrate_albedo(lobe, 48, 512);
    const std::array<double, kLtcRowFloats> row{std::cos(shape.tilt),
                                                std::sin(shape.tilt),
                                                shape.stretch,
                                                shape.lift,
                                                albedo.norm,
                                                albedo.fresnel,
                                                0,
                                                0};
    TableRow result{};
    for (std::size_t i = 0; i < row.size(); ++i) result[i] = static_cast<float>(row[i]);
    return result;
}

// The shape that a row was made from.
inline LtcShape shape_of_row(const float* row) {
    return {row[2], std::atan2(static_cast<double>(row[1]), static_cast<double>(row[0])), row[3]};
}

// The rows of one roughness.
inline std::vector<TableRow> table_rows(int roughness_index, const FitSettings& settings) {
    const double roughness = node_roughness(roughness_index);
    const std::vector<LtcShape> shapes = fit_roughness(roughness, settings);
    std::vector<TableRow> rows;
    rows.reserve(kLtcAngleNodes);
    for (int angle = 0; angle < kLtcAngleNodes; ++angle)
        rows.push_back(
            table_row({roughness, node_cos_view(angle)}, shapes[static_cast<std::size_t>(angle)]));
    return rows;
}

}  // namespace penumbra::ltc_fit
