#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/profile/work.h"

// The passes of a frame, each listed once: the renderer's clock, the statistics, the trace and the
// benchmark go through this table. A new pass is a row here, and a clock's call where it runs.

namespace penumbra::renderer {

// In their order.
enum class Pass {
    kEvaluate,   // scene at the frame's time, occluders
    kSetup,      // vertices to clip space, triangles to bins
    kRasterize,  // tiles, from here ...
    kResolve,
    kShade,  // U, visible lights
    kRays,   // shadow rays and their weights, sums
    kTrace,
    kDeposit,  // ... to here
    kNoise,    // frame passes
    kFilter,
};

// Those of the tiles are measured in seconds of all threads together, the others in wall-clock
// seconds.
enum class PassScope { kFrame, kTile };

// Passes that are told together, too.
enum class PassGroup { kNone, kVisibility, kShadow, kDenoise };

// What throughput is told in.
struct CountedWork {
    bool pixels = false, triangles = false, rays = false;
};

// What a pass must do at least, per unit of the frame's work: bytes moved where its limit is a
// stream, multiply-adds where it is arithmetic. docs/bench.md explains the numbers.
struct LeastWork {
    std::uint64_t per_pixel = 0, per_vertex = 0, per_triangle = 0, per_ray = 0;
    std::uint64_t per_shaded_pair = 0;    // of a pixel and a light that it may see
    std::uint64_t per_shaded_vertex = 0;  // of those lights
};

struct PassInfo {
    Pass pass;
    std::string_view name;  // a literal: slices of the trace keep its address
    PassScope scope;
    PassGroup group;
    CountedWork work;
    profile::LimitKind limit;  // what bounds it from below
    LeastWork least;
};

struct PassGroupInfo {
    PassGroup group;
    std::string_view name;
    profile::LimitKind limit;  // bare rays stand for the whole group, streams add up
};

namespace pass_table_detail {

using enum PassScope;
using enum profile::LimitKind;

inline constexpr std::uint64_t kFloat = 4;
// Positions and indices in, a reference per triangle and bin out.
inline constexpr std::uint64_t kPosition = 3 * kFloat, kIndices = 3 * kFloat, kReference = 4;
// Planes: U, S, U_N and emission of three channels each, coverage, depth, a normal.
inline constexpr std::uint64_t kDeposited = 17;
// S, U_N and U in, E out.
inline constexpr std::uint64_t kNoisePlanes = 10;
// Across: E, depth, normal, S and U_N in, S and U_N out. Down: the same in, with U and emission,
// the picture out.
inline constexpr std::uint64_t kFiltered = (5 + 6 + 6) + (5 + 6 + 6 + 3);
// Two lobes. A vertex: a transform (9), and its edge's dot and cross product, length and
// theta / sin theta (20). A pixel: two rows of 8 numbers of the table, interpolated in two
// directions (32).
inline constexpr std::uint64_t kPerVertex = 2 * (9 + 20), kPerPair = 32;
// A ray: its place on a spherical triangle (60), the BRDF with its densities (40).
inline constexpr std::uint64_t kPerRay = 100;

inline constexpr auto kPasses = std::to_array<PassInfo>({
    {.pass = Pass::kEvaluate,
     .name = "evaluate",
     .scope = kFrame,
     .group = PassGroup::kNone,
     .work = {.triangles = true},
     .limit = kNone,
     .least = {}},
    {.pass = Pass::kSetup,
     .name = "setup",
     .scope = kFrame,
     .group = PassGroup::kVisibility,
     .work = {.triangles = true},
     .limit = kStream,
     .least = {.per_vertex = kPosition, .per_triangle = kIndices + kReference}},
    {.pass = Pass::kRasterize,
     .name = "rasterize",
     .scope = kTile,
     .group = PassGroup::kVisibility,
     .work = {.pixels = true, .triangles = true},
     .limit = kPrimaryRays,
     .least = {}},
    {.pass = Pass::kResolve,
     .name = "resolve",
     .scope = kTile,
     .group = PassGroup::kVisibility,
     .work = {.pixels = true},
     .limit = kPrimaryRays,
     .least = {}},
    {.pass = Pass::kShade,
     .name = "shade",
     .scope = kTile,
     .group = PassGroup::kShadow,
     .work = {.pixels = true},
     .limit = kArithmetic,
     .least = {.per_shaded_pair = kPerPair, .per_shaded_vertex = kPerVertex}},
    {.pass = Pass::kRays,
     .name = "rays",
     .scope = kTile,
     .group = PassGroup::kShadow,
     .work = {.pixels = true, .rays = true},
     .limit = kArithmetic,
     .least = {.per_ray = kPerRay}},
    {.pass = Pass::kTrace,
     .name = "trace",
     .scope = kTile,
     .group = PassGroup::kShadow,
     .work = {.rays = true},
     .limit = kShadowRays,
     .least = {}},
    {.pass = Pass::kDeposit,
     .name = "deposit",
     .scope = kTile,
     .group = PassGroup::kNone,
     .work = {.pixels = true},
     .limit = kStream,
     .least = {.per_pixel = kDeposited * kFloat}},
    {.pass = Pass::kNoise,
     .name = "noise",
     .scope = kFrame,
     .group = PassGroup::kDenoise,
     .work = {.pixels = true},
     .limit = kStream,
     .least = {.per_pixel = kNoisePlanes * kFloat}},
    {.pass = Pass::kFilter,
     .name = "filter",
     .scope = kFrame,
     .group = PassGroup::kDenoise,
     .work = {.pixels = true},
     .limit = kStream,
     .least = {.per_pixel = kFiltered * kFloat}},
});

inline constexpr auto kGroups = std::to_array<PassGroupInfo>({
    {PassGroup::kVisibility, "visibility", kPrimaryRays},
    {PassGroup::kShadow, "shadow", kShadowRays},
    {PassGroup::kDenoise, "denoise", kStream},
});

constexpr bool is_in_order() {
    for (std::size_t i = 0; i < kPasses.size(); ++i)
        if (static_cast<std::size_t>(kPasses[i].pass) != i) return false;
    return true;
}
static_assert(is_in_order(), "the table is indexed by pass");

}  // namespace pass_table_detail

inline constexpr const auto& kPasses = pass_table_detail::kPasses;
inline constexpr const auto& kPassGroups = pass_table_detail::kGroups;
inline constexpr int kPassCount = static_cast<int>(kPasses.size());

[[nodiscard]] constexpr const PassInfo& info(Pass pass) {
    return kPasses[static_cast<std::size_t>(pass)];
}
[[nodiscard]] constexpr std::string_view name(Pass pass) {
    return info(pass).name;
}
[[nodiscard]] constexpr bool is_tile_pass(Pass pass) {
    return info(pass).scope == PassScope::kTile;
}

}  // namespace penumbra::renderer
