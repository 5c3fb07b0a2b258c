#include "apps/renderer/aov.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"

namespace penumbra::renderer {

std::span<const AovInfo> aov_table() {
    using enum SampleType;
    static const std::vector<AovInfo> kTable = {
        {Aov::kBeauty, "beauty", {"R", "G", "B", "A"}, kHalf, "radiance; A = coverage"},
        {Aov::kU, "U", {"U.R", "U.G", "U.B"}, kHalf, "analytic unshadowed radiance"},
        {Aov::kS, "S", {"S.R", "S.G", "S.B"}, kHalf, "shadowed sum per sample, filtered"},
        {Aov::kUn, "Un", {"Un.R", "Un.G", "Un.B"}, kHalf, "unshadowed sum per sample, filtered"},
        {Aov::kW,
         "W",
         {"W.R", "W.G", "W.B"},
         kHalf,
         "the shadow, S / Un in [0,1]; 1 where nothing is hit"},
        {Aov::kE, "E", {"E"}, kHalf, "noise estimate in [0,1]"},
        {Aov::kEmission,
         "emission",
         {"emission.R", "emission.G", "emission.B"},
         kHalf,
         "radiance seen directly: emissive surfaces, visible lights, background"},
        {Aov::kAlbedo, "albedo", {"albedo.R", "albedo.G", "albedo.B"}, kHalf, "base colour"},
        {Aov::kRoughness, "roughness", {"roughness"}, kHalf, "GGX alpha is its square"},
        {Aov::kMetallic, "metallic", {"metallic"}, kHalf, "in [0,1]"},
        {Aov::kN, "N", {"N.X", "N.Y", "N.Z"}, kHalf, "shading normal, world, towards the viewer"},
        {Aov::kNg,
         "Ng",
         {"Ng.X", "Ng.Y", "Ng.Z"},
         kHalf,
         "geometric normal, world, towards the viewer"},
        {Aov::kP, "P", {"P.X", "P.Y", "P.Z"}, kFloat, "world position in metres"},
        {Aov::kZ,
         "Z",
         {"Z"},
         kFloat,
         "distance along the view axis in metres; 1e10 where nothing is hit"},
        {Aov::kMotion,
         "motion",
         {"motion.X", "motion.Y"},
         kFloat,
         "pixel now - pixel in the previous frame, x right, y down"},
        {Aov::kId,
         "id",
         {"id.instance", "id.triangle", "id.material"},
         kUint,
         "4294967295 where nothing is hit"},
    };
    return kTable;
}

const AovInfo& info(Aov aov) {
    return aov_table()[static_cast<std::size_t>(aov)];
}

AovSet parse_aov_list(std::string_view text) {
    AovSet set;
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        std::string_view item = rest.substr(0, comma);
        while (!item.empty() && item.front() == ' ') item.remove_prefix(1);
        while (!item.empty() && item.back() == ' ') item.remove_suffix(1);
        const auto known = std::ranges::find(aov_table(), item, &AovInfo::name);
        if (item == "all") {
            for (const AovInfo& each : aov_table()) set.insert(each.aov);
        } else if (known != aov_table().end()) {
            set.insert(known->aov);
        } else {
            std::vector<std::string_view> names{"all"};
            for (const AovInfo& each : aov_table()) names.push_back(each.name);
            throw InputError(fmt::format("--aov: expected some of {}, got \"{}\"",
                                         fmt::join(names, ", "), item));
        }
        if (comma == std::string_view::npos) return set;
        rest.remove_prefix(comma + 1);
    }
}

}  // namespace penumbra::renderer
