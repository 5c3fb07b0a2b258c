#include "apps/renderer/aov.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/renderer/film.h"
#include "core/error.h"
#include "core/frame/visibility.h"

namespace penumbra::renderer {
namespace {

// Of the surface that a tile's passes left.
template <auto member>
PlaneView<const float> number(const ConstSurfaceView& surface) {
    return surface.*member;
}
template <auto member, std::size_t i>
PlaneView<const float> component(const ConstSurfaceView& surface) {
    return (surface.*member)[i];
}
template <auto member>
PlaneView<const std::uint32_t> ids(const ConstSurfaceView& surface) {
    return surface.*member;
}

// Of what the film holds anyway.
template <auto member, std::size_t i>
const Plane<float>& of_film(const Film& film) {
    return (film.*member)[i];
}
template <auto member, std::size_t i>
const Plane<float>& of_total(const Film& film) {
    return (film.total().*member)[i];
}
const Plane<float>& noise_of_total(const Film& film) {
    return film.total().noise;
}
const Plane<float>& depth_of_film(const Film& film) {
    return film.depth;
}

// 1 where something is hit; a visible light has a depth, but no id.
void coverage(const TileResult& from, int y, float* row) {
    const float* const z = from.surface.depth.row(y);
    for (int x = 0; x < kTileSize; ++x) row[x] = z[x] < kDepthOfNothing ? 1.0f : 0.0f;
}

// n.v of the shading normal, which is 0 where nothing is hit.
void facing(const TileResult& from, int y, float* row) {
    const auto read = [&](const PlaneView3<const float>& planes, int x) {
        return Vec3f{planes[0].at(x, y), planes[1].at(x, y), planes[2].at(x, y)};
    };
    for (int x = 0; x < kTileSize; ++x) {
        const Vec3f to_eye = from.camera.eye - read(from.surface.position, x);
        const float cosine = dot(read(from.surface.normal, x), to_eye) / length(to_eye);
        row[x] = cosine > 0 ? std::min(cosine, 1.0f) : 0.0f;  // 0 too where the eye is the origin
    }
}

namespace rows {

using enum SampleType;
using enum AovPasses;
using Surface = ConstSurfaceView;

constexpr auto kTable = std::to_array<AovInfo>({
    {.aov = Aov::kBeauty,
     .name = "beauty",
     .type = kHalf,
     .nothing = {},
     .passes = kMean,
     .slots = {{{"R", of_film<&Film::beauty, 0>},
                {"G", of_film<&Film::beauty, 1>},
                {"B", of_film<&Film::beauty, 2>},
                {"A", RowFormula{coverage}}}},
     .description = "radiance; A = coverage"},
    {.aov = Aov::kU,
     .name = "U",
     .type = kHalf,
     .nothing = 0,
     .passes = kMean,
     .slots = {{{"U.R", of_total<&Term::unshadowed, 0>},
                {"U.G", of_total<&Term::unshadowed, 1>},
                {"U.B", of_total<&Term::unshadowed, 2>}}},
     .description = "analytic unshadowed radiance"},
    {.aov = Aov::kS,
     .name = "S",
     .type = kHalf,
     .nothing = 0,
     .passes = kMean,
     .slots = {{{"S.R", of_total<&Term::filtered_shadowed, 0>},
                {"S.G", of_total<&Term::filtered_shadowed, 1>},
                {"S.B", of_total<&Term::filtered_shadowed, 2>}}},
     .description = "shadowed sum per sample, filtered"},
    {.aov = Aov::kUn,
     .name = "Un",
     .type = kHalf,
     .nothing = 0,
     .passes = kMean,
     .slots = {{{"Un.R", of_total<&Term::filtered_unshadowed_samples, 0>},
                {"Un.G", of_total<&Term::filtered_unshadowed_samples, 1>},
                {"Un.B", of_total<&Term::filtered_unshadowed_samples, 2>}}},
     .description = "unshadowed sum per sample, filtered"},
    {.aov = Aov::kW,
     .name = "W",
     .type = kHalf,
     .nothing = 1,
     .passes = kMean,
     .slots = {{{"W.R", of_total<&Term::ratio, 0>},
                {"W.G", of_total<&Term::ratio, 1>},
                {"W.B", of_total<&Term::ratio, 2>}}},
     .description = "the shadow, S / Un in [0,1]"},
    {.aov = Aov::kE,
     .name = "E",
     .type = kHalf,
     .nothing = {},
     .passes = kMean,
     .slots = {{{"E", noise_of_total}}},
     .description = "noise estimate in [0,1], of a neighbourhood"},
    {.aov = Aov::kEmission,
     .name = "emission",
     .type = kHalf,
     .nothing = {},
     .passes = kMean,
     .slots = {{{"emission.R", of_film<&Film::emission, 0>},
                {"emission.G", of_film<&Film::emission, 1>},
                {"emission.B", of_film<&Film::emission, 2>}}},
     .description = "radiance seen directly: emissive surfaces, visible lights, background"},
    {.aov = Aov::kAlbedo,
     .name = "albedo",
     .type = kHalf,
     .nothing = 0,
     .passes = kMean,
     .slots = {{{"albedo.R", component<&Surface::base_color, 0>},
                {"albedo.G", component<&Surface::base_color, 1>},
                {"albedo.B", component<&Surface::base_color, 2>}}},
     .description = "base colour"},
    {.aov = Aov::kRoughness,
     .name = "roughness",
     .type = kHalf,
     .nothing = 0,
     .passes = kMean,
     .slots = {{{"roughness", number<&Surface::roughness>}}},
     .description = "GGX alpha is its square"},
    {.aov = Aov::kMetallic,
     .name = "metallic",
     .type = kHalf,
     .nothing = 0,
     .passes = kMean,
     .slots = {{{"metallic", number<&Surface::metallic>}}},
     .description = "in [0,1]"},
    {.aov = Aov::kN,
     .name = "N",
     .type = kHalf,
     .nothing = 0,
     .passes = kFirst,
     .slots = {{{"N.X", component<&Surface::normal, 0>},
                {"N.Y", component<&Surface::normal, 1>},
                {"N.Z", component<&Surface::normal, 2>}}},
     .description = "shading normal, world, towards the viewer"},
    {.aov = Aov::kNg,
     .name = "Ng",
     .type = kHalf,
     .nothing = 0,
     .passes = kFirst,
     .slots = {{{"Ng.X", of_film<&Film::geometric_normal, 0>},
                {"Ng.Y", of_film<&Film::geometric_normal, 1>},
                {"Ng.Z", of_film<&Film::geometric_normal, 2>}}},
     .description = "geometric normal, world, towards the viewer"},
    {.aov = Aov::kFacing,
     .name = "facing",
     .type = kHalf,
     .nothing = 0,
     .passes = kMean,
     .slots = {{{"facing", RowFormula{facing}}}},
     .description = "cosine of the shading normal and the direction to the eye, in [0,1]"},
    {.aov = Aov::kP,
     .name = "P",
     .type = kFloat,
     .nothing = 0,
     .passes = kFirst,
     .slots = {{{"P.X", component<&Surface::position, 0>},
                {"P.Y", component<&Surface::position, 1>},
                {"P.Z", component<&Surface::position, 2>}}},
     .description = "world position in metres"},
    {.aov = Aov::kZ,
     .name = "Z",
     .type = kFloat,
     .nothing = kDepthOfNothing,
     .passes = kFirst,
     .slots = {{{"Z", depth_of_film}}},
     .description = "distance along the view axis in metres"},
    {.aov = Aov::kMotion,
     .name = "motion",
     .type = kFloat,
     .nothing = 0,
     .passes = kFirst,
     .slots = {{{"motion.X", number<&Surface::motion_x>},
                {"motion.Y", number<&Surface::motion_y>}}},
     .description = "pixel now - pixel in the previous frame, x right, y down"},
    {.aov = Aov::kId,
     .name = "id",
     .type = kUint,
     .nothing = kNothing,
     .passes = kFirst,
     .slots = {{{"id.instance", ids<&Surface::instance>},
                {"id.triangle", ids<&Surface::triangle>},
                {"id.material", ids<&Surface::material>}}},
     .description = "of the instance, its triangle, the material"},
});

}  // namespace rows

using rows::kTable;

constexpr bool is_in_order() {
    for (std::size_t i = 0; i < kTable.size(); ++i)
        if (static_cast<std::size_t>(kTable[i].aov) != i) return false;
    return true;
}
static_assert(is_in_order(), "the table is indexed by AOV");

}  // namespace

std::span<const AovInfo> aov_table() {
    return kTable;
}

const AovInfo& info(Aov aov) {
    return kTable[static_cast<std::size_t>(aov)];
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
