#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::renderer {

// What a frame's file can hold beside the picture.
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
    kP,       // world position
    kZ,       // distance along the view axis
    kMotion,  // pixel now - pixel in the previous frame
    kId,      // instance, triangle, material
};

enum class SampleType { kHalf, kFloat, kUint };  // half becomes float with --precision float

struct AovInfo {
    Aov aov;
    std::string_view name;                   // as --aov takes it
    std::vector<std::string_view> channels;  // as the file names them
    SampleType type;
    std::string_view description;
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
