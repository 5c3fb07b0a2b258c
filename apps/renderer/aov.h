#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/frame/camera.h"
#include "core/frame/light_sums.h"
#include "core/frame/surface.h"
#include "core/frame/tile.h"

namespace penumbra::renderer {

struct Film;

// What a frame's file can hold beside the picture. A new one is its name here and its row of the
// table in aov.cpp: film, tiles and file follow the table.
enum class Aov {
    kBeauty,    // emission + sum U * W, with coverage as alpha
    kU,         // analytic unshadowed radiance
    kS,         // S_N after the filter, per sample
    kUn,        // U_N after the filter, per sample
    kW,         // the shadow: S / U_N
    kE,         // noise estimate
    kEmission,  // radiance seen directly: emissive surfaces, visible lights, background
    kAlbedo,    // base colour
    kRoughness,
    kMetallic,
    kN,       // shading normal, world, towards the viewer
    kNg,      // geometric normal, likewise
    kFacing,  // cosine of the shading normal and the direction to the eye
    kP,       // world position
    kZ,       // distance along the view axis
    kMotion,  // pixel now - pixel in the previous frame
    kId,      // instance, triangle, material
};

enum class SampleType { kHalf, kFloat, kUint };  // half becomes float with --precision float

// What of several --aa passes is kept.
enum class AovPasses { kFirst, kMean };

// What a tile's passes left in scratch.
struct TileResult {
    const Tile& tile;
    int pass;  // of --aa
    const ConstSurfaceView& surface;
    const ConstLightSumsView& sums;
    const Camera& camera;  // with the pass's jitter
};

// Where a channel comes from. The first three are taken from each tile into planes that the film
// has for this AOV alone; the last is what the film holds anyway.
using SurfaceNumbers = PlaneView<const float> (*)(const ConstSurfaceView&);
using SurfaceIds = PlaneView<const std::uint32_t> (*)(const ConstSurfaceView&);
using RowFormula = void (*)(const TileResult&, int y, float* row);  // kTileSize numbers
using FilmPlane = const Plane<float>& (*)(const Film&);
using AovSource = std::variant<SurfaceNumbers, SurfaceIds, RowFormula, FilmPlane>;

struct AovChannel {
    std::string_view name;  // as the file names it
    AovSource source;
};

struct AovInfo {
    Aov aov;
    std::string_view name;  // as --aov takes it
    SampleType type;
    std::optional<double> nothing;  // the value where nothing is hit, unless that is no constant
    AovPasses passes;
    std::array<AovChannel, 4> slots;  // those without a name are none
    std::string_view description;

    [[nodiscard]] constexpr std::span<const AovChannel> channels() const {
        std::size_t count = 0;
        while (count < slots.size() && !slots[count].name.empty()) ++count;
        return {slots.data(), count};
    }
};

// All of them, in the order of the enumeration.
[[nodiscard]] std::span<const AovInfo> aov_table();
[[nodiscard]] const AovInfo& info(Aov aov);

// A set of AOVs.
class AovSet {
  public:
    AovSet() = default;
    AovSet(std::initializer_list<Aov> aovs) {
        for (const Aov aov : aovs) insert(aov);
    }
    void insert(Aov aov) { bits_ |= 1u << static_cast<unsigned>(aov); }
    [[nodiscard]] bool contains(Aov aov) const {
        return (bits_ >> static_cast<unsigned>(aov) & 1) != 0;
    }
    friend bool operator==(AovSet, AovSet) = default;

  private:
    unsigned bits_ = 0;
};

// From "beauty,Z,N"; "all" is everything. Throws InputError that lists the known names.
[[nodiscard]] AovSet parse_aov_list(std::string_view text);

}  // namespace penumbra::renderer
