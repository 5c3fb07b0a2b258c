#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/error.h"
#include "core/scene/polygon_soup.h"

namespace penumbra {
namespace {

std::uint64_t hash_of(const Vec3f& p) {
    // splitmix64's finisher over the three coordinates.
    std::uint64_t h = 0x9E3779B97F4A7C15u;
    for (const float x : {p.x, p.y, p.z}) {
        h ^= std::bit_cast<std::uint32_t>(x + 0.0f);  // -0 equals +0
        h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9u;
        h = (h ^ (h >> 27)) * 0x94D049BB133111EBu;
        h ^= h >> 31;
    }
    return h;
}

Vec3f unit(const Vec3f& v) {
    const double x = v.x;
    const double y = v.y;
    const double z = v.z;
    const double scale = 1 / std::sqrt(x * x + y * y + z * z);
    return {static_cast<float>(x * scale), static_cast<float>(y * scale),
            static_cast<float>(z * scale)};
}

// Splits positions into vertices. Those of one position form a list, which is searched for the
// corner's normal and texture coordinates: 12 bytes per vertex, and no hashing.
class VertexTable {
  public:
    explicit VertexTable(std::size_t positions) : first_(positions, kNoIndex) {
        next_.reserve(positions);
        normal_.reserve(positions);
    }

    struct Found {
        std::uint32_t vertex;
        bool is_new;
    };
    Found find_or_add(std::uint32_t position, std::uint32_t normal, std::uint32_t uv) {
        for (std::uint32_t v = first_[position]; v != kNoIndex; v = next_[v])
            if (normal_[v] == normal && uv_of(v) == uv) return {v, false};
        const auto vertex = static_cast<std::uint32_t>(next_.size());
        next_.push_back(first_[position]);
        normal_.push_back(normal);
        if (uv != kNoIndex && uv_.empty()) uv_.assign(vertex, kNoIndex);
        if (uv != kNoIndex || !uv_.empty()) uv_.push_back(uv);
        first_[position] = vertex;
        return {vertex, true};
    }

  private:
    [[nodiscard]] std::uint32_t uv_of(std::uint32_t v) const {
        return v < uv_.size() ? uv_[v] : kNoIndex;
    }
    std::vector<std::uint32_t> first_, next_, normal_, uv_;
};

std::uint32_t index_or_none(const std::vector<std::uint32_t>& indices, std::size_t corner) {
    return corner < indices.size() ? indices[corner] : kNoIndex;
}

template <class T>
void release(std::vector<T>& data) {
    std::vector<T>().swap(data);
}

}  // namespace

bool has_area(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    const auto wide = [](const Vec3f& v) { return Vec3d{v.x, v.y, v.z}; };
    const Vec3d doubled_area = cross(wide(b) - wide(a), wide(c) - wide(a));
    // As a float: smaller areas are zero to everybody who reads the mesh.
    return length(doubled_area) / 2 >= std::numeric_limits<float>::min();
}

std::vector<std::uint32_t> weld(const std::vector<Vec3f>& positions) {
    const std::size_t slots = std::bit_ceil(positions.size() * 2 + 2);
    std::vector<std::uint32_t> table(slots, kNoIndex);
    std::vector<std::uint32_t> first(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3f& p = positions[i];
        std::size_t slot = hash_of(p) & (slots - 1);
        while (table[slot] != kNoIndex) {
            const Vec3f& q = positions[table[slot]];
            if (p.x == q.x && p.y == q.y && p.z == q.z) break;
            slot = (slot + 1) & (slots - 1);
        }
        if (table[slot] == kNoIndex) table[slot] = static_cast<std::uint32_t>(i);
        first[i] = table[slot];
    }
    return first;
}

Mesh build_mesh(PolygonSoup&& soup) {
    add_missing_normals(soup);
    Mesh mesh;
    mesh.name = soup.name;
    mesh.dropped_triangles = soup.dropped_triangles;
    mesh.triangle_slots = std::move(soup.triangle_slots);
    mesh.triangles.resize(soup.triangle_count());
    mesh.positions.reserve(soup.positions.size());
    mesh.normals.reserve(soup.positions.size());
    VertexTable vertices(soup.positions.size());
    const bool has_uvs = !soup.corner_uvs.empty();
    for (std::size_t corner = 0; corner < soup.corner_positions.size(); ++corner) {
        const std::uint32_t position = soup.corner_positions[corner];
        const std::uint32_t normal = soup.corner_normals[corner];
        const std::uint32_t uv = index_or_none(soup.corner_uvs, corner);
        const auto [vertex, is_new] = vertices.find_or_add(position, normal, uv);
        mesh.triangles[corner / 3].vertex[corner % 3] = vertex;
        if (!is_new) continue;
        mesh.positions.push_back(soup.positions[position]);
        mesh.normals.push_back(unit(soup.normals[normal]));
        if (has_uvs) mesh.uvs.push_back(uv == kNoIndex ? Vec2f{0, 0} : soup.uvs[uv]);
    }
    release(soup.corner_positions);
    release(soup.corner_normals);
    release(soup.corner_uvs);
    mesh.positions.shrink_to_fit();
    mesh.normals.shrink_to_fit();
    mesh.uvs.shrink_to_fit();
    return mesh;
}

}  // namespace penumbra
