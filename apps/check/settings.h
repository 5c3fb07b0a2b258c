#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "apps/diff/metric.h"

namespace penumbra::check {

// An option of the program that renders, which a check may set: "spp", "reproducible" (a flag).
struct RenderOption {
    std::string name;
    bool is_flag = false;
};
// Option -> value as on a command line; "true" of flags.
using RenderValues = std::map<std::string, std::string>;

// What NAME.check.json says: how the scene is rendered and how much may differ. Without such a file
// all of it has its defaults: the scene's own settings, and no difference at all.
struct CheckSettings {
    std::filesystem::path scene;  // empty: NAME.json or NAME.obj beside the file
    RenderValues render;
    std::vector<diff::Threshold> thresholds;
    double pixel_threshold = 0;
    std::set<std::string> ignored_layers;
    std::filesystem::path mask;  // empty: none
    std::string reason;          // why something may differ

    [[nodiscard]] bool tolerates_anything() const;
};

// Throws InputError with the place in the file; a file that lets anything differ has to say why.
[[nodiscard]] CheckSettings read_settings(const std::filesystem::path& file,
                                          std::span<const RenderOption> known);

}  // namespace penumbra::check
