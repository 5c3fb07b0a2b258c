#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/scene.h"

// Triangles as a model file states them: every corner refers to a position and maybe to a normal
// and texture coordinates of their own. What readers hand to build_mesh.

namespace penumbra {

inline constexpr std::uint32_t kNoIndex = 0xFFFFFFFFu;

struct PolygonSoup {
    std::string name;
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals;  // of any length
    std::vector<Vec2f> uvs;
    // Three entries a triangle, all indices valid; the latter two are empty where no corner has
    // any, and may be shorter than the first: what is missing is kNoIndex.
    std::vector<std::uint32_t> corner_positions, corner_normals, corner_uvs;
    std::vector<std::uint16_t> triangle_slots;
    std::size_t dropped_triangles = 0;

    [[nodiscard]] std::size_t triangle_count() const { return corner_positions.size() / 3; }
};

// Edges between faces whose normals differ by less than this stay smooth where a model has no
// normals of its own: a cylinder of eight sides (45 degrees) is round, a hexagonal prism (60) is
// not.
inline constexpr double kCreaseDegrees = 50;

// Gives every corner without a normal (or with one of length zero) the mean of the face normals
// around its position, up to the creases; faces weigh by their angle there, so that the result does
// not depend on how polygons were cut. Positions of equal coordinates count as one. Appends to
// `normals`.
void add_missing_normals(PolygonSoup& soup);

// Whether a triangle has an area; if not, it is not to be in a soup.
[[nodiscard]] bool has_area(const Vec3f& a, const Vec3f& b, const Vec3f& c);

// Per position, the index of the first one with the same coordinates.
[[nodiscard]] std::vector<std::uint32_t> weld(const std::vector<Vec3f>& positions);

// One index per vertex: corners that agree in all three become one vertex, in the order of first
// use. Consumes the soup to spare memory.
[[nodiscard]] Mesh build_mesh(PolygonSoup&& soup);

}  // namespace penumbra
