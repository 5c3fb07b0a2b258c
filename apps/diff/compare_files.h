#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "apps/diff/mask.h"
#include "apps/diff/report.h"
#include "core/parallel/arena.h"

namespace penumbra::diff {

enum class PictureWish { kNone, kHeat, kAll };

struct CompareSettings {
    MetricSet metrics;  // those of the thresholds included
    std::vector<Threshold> thresholds;
    double pixel_threshold = 0;
    std::set<std::string> ignored_layers;
    const Mask* mask = nullptr;
    PictureWish pictures = PictureWish::kNone;
};

// Compares two files. What is wrong with them, unreadable ones included, stands in the report.
// Images are read in bands: memory does not grow with their height.
[[nodiscard]] PairReport compare_files(const std::filesystem::path& reference,
                                       const std::filesystem::path& test,
                                       const CompareSettings& settings,
                                       const parallel::Arena& arena);

}  // namespace penumbra::diff
