#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/math/portable.h"
#include "core/math/widen.h"
#include "core/scene/polygon_soup.h"

namespace penumbra {
namespace {

using Index = std::uint32_t;

Vec3d minus(const Vec3f& a, const Vec3f& b) {
    return {double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z};
}
double plain_dot(const Vec3d& a, const Vec3d& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec3d plain_cross(const Vec3d& a, const Vec3d& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

bool is_usable(const Vec3f& normal) {
    const Vec3d n = widen(normal);
    return plain_dot(n, n) > 1e-24;
}

// A face at one of its corners, as seen from the vertex.
struct Wedge {
    Index corner;
    Index next, previous;  // welded positions at the other ends of the corner's edges
    Vec3d normal;          // unit
    double angle;
    Index group;  // index of the first wedge that it is smooth with, found by root()
};

// An edge at the vertex, of one wedge.
struct Spoke {
    Index far_end;
    Index wedge;
};

// The wedges around one vertex; memory is kept from vertex to vertex.
class Fan {
  public:
    void clear() {
        wedges_.clear();
        spokes_.clear();
    }

    void add(const PolygonSoup& soup, const std::vector<Index>& welded, Index corner) {
        const Index first = corner - corner % 3;
        const Index next = first + (corner + 1) % 3;
        const Index previous = first + (corner + 2) % 3;
        const Index here = soup.corner_positions[corner];
        const Index there = soup.corner_positions[next];
        const Index behind = soup.corner_positions[previous];
        const Vec3d a = minus(soup.positions[there], soup.positions[here]);
        const Vec3d b = minus(soup.positions[behind], soup.positions[here]);
        const Vec3d n = plain_cross(a, b);
        const double size = std::sqrt(plain_dot(n, n));
        const auto index = static_cast<Index>(wedges_.size());
        wedges_.push_back({.corner = corner,
                           .next = welded[there],
                           .previous = welded[behind],
                           .normal = n * (1 / size),
                           .angle = portable::atan2(size, plain_dot(a, b)),
                           .group = index});
        spokes_.push_back({welded[there], index});
        spokes_.push_back({welded[behind], index});
    }

    // Joins the faces that share an edge and bend less than the crease angle over it.
    void join() {
        std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& a, const Spoke& b) {
            return a.far_end != b.far_end ? a.far_end < b.far_end : a.wedge < b.wedge;
        });
        for (std::size_t i = 0; i < spokes_.size(); ++i) {
            // Two faces meet at most edges; where very many do, each is compared with a few.
            constexpr std::size_t kCompared = 8;
            const std::size_t end = std::min(spokes_.size(), i + 1 + kCompared);
            for (std::size_t j = i + 1; j < end && spokes_[j].far_end == spokes_[i].far_end; ++j)
                join_if_smooth(spokes_[i].wedge, spokes_[j].wedge);
        }
    }

    // Gives each group its mean normal.
    void assign(PolygonSoup& soup) {
        sums_.assign(wedges_.size(), Vec3d{0, 0, 0});
        ids_.assign(wedges_.size(), kNoIndex);
        for (Index i = 0; i < wedges_.size(); ++i)
            sums_[root(i)] += wedges_[i].normal * wedges_[i].angle;
        for (Index i = 0; i < wedges_.size(); ++i) {
            Index& normal = soup.corner_normals[wedges_[i].corner];
            if (normal != kNoIndex) continue;
            const Index group = root(i);
            if (ids_[group] == kNoIndex) ids_[group] = append(soup, group);
            normal = ids_[group];
        }
    }

    [[nodiscard]] bool empty() const { return wedges_.empty(); }

  private:
    Index root(Index i) {
        while (wedges_[i].group != i) {
            wedges_[i].group = wedges_[wedges_[i].group].group;
            i = wedges_[i].group;
        }
        return i;
    }

    void join_if_smooth(Index a, Index b) {
        static const double kLeastCosine = portable::cos(kCreaseDegrees * (std::numbers::pi / 180));
        if (plain_dot(wedges_[a].normal, wedges_[b].normal) <= kLeastCosine) return;
        const Index group_a = root(a);
        const Index group_b = root(b);
        wedges_[std::max(group_a, group_b)].group = std::min(group_a, group_b);
    }

    Index append(PolygonSoup& soup, Index group) const {
        const Vec3d& sum = sums_[group];
        const double size = std::sqrt(plain_dot(sum, sum));
        const Vec3d n = size > 1e-6 ? sum * (1 / size) : wedges_[group].normal;
        soup.normals.push_back(
            {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
        return static_cast<Index>(soup.normals.size() - 1);
    }

    std::vector<Wedge> wedges_;
    std::vector<Spoke> spokes_;
    std::vector<Vec3d> sums_;
    std::vector<Index> ids_;
};

// The corners at each welded position, in the corners' order.
struct CornerLists {
    std::vector<Index> start;  // one more than positions
    std::vector<Index> corners;
};

CornerLists corners_by_position(const PolygonSoup& soup, const std::vector<Index>& welded) {
    CornerLists lists;
    lists.start.assign(soup.positions.size() + 1, 0);
    for (const Index position : soup.corner_positions) ++lists.start[welded[position] + 1];
    std::partial_sum(lists.start.begin(), lists.start.end(), lists.start.begin());
    lists.corners.resize(soup.corner_positions.size());
    // Filling moves each start to the next one's place; it is moved back after.
    for (Index corner = 0; corner < soup.corner_positions.size(); ++corner)
        lists.corners[lists.start[welded[soup.corner_positions[corner]]]++] = corner;
    std::rotate(lists.start.rbegin(), lists.start.rbegin() + 1, lists.start.rend());
    lists.start[0] = 0;
    return lists;
}

}  // namespace

void add_missing_normals(PolygonSoup& soup) {
    soup.corner_normals.resize(soup.corner_positions.size(), kNoIndex);
    for (Index& normal : soup.corner_normals)
        if (normal != kNoIndex && !is_usable(soup.normals[normal])) normal = kNoIndex;
    const auto& normals = soup.corner_normals;
    if (std::find(normals.begin(), normals.end(), kNoIndex) == normals.end()) return;

    const std::vector<Index> welded = weld(soup.positions);
    const CornerLists lists = corners_by_position(soup, welded);
    Fan fan;
    for (std::size_t position = 0; position < soup.positions.size(); ++position) {
        const auto begin = lists.corners.begin() + lists.start[position];
        const auto end = lists.corners.begin() + lists.start[position + 1];
        if (std::none_of(begin, end, [&](Index c) { return normals[c] == kNoIndex; })) continue;
        fan.clear();
        std::for_each(begin, end, [&](Index corner) { fan.add(soup, welded, corner); });
        fan.join();
        fan.assign(soup);
    }
}

}  // namespace penumbra
