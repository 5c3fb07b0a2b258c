#include "core/scene/triangulate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/scene/light_polygon.h"

namespace penumbra {
namespace {

using Index = std::uint32_t;
using Point = Vec2<double>;

double doubled_area(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The polygon along the dominant axis of its normal, counter-clockwise.
std::vector<Point> project(std::span<const Vec3f> corners) {
    std::vector<Vec3d> points;
    for (const Vec3f& c : corners) points.push_back({c.x, c.y, c.z});
    const Vec3d n = newell_normal(points);
    const double ax = std::fabs(n.x);
    const double ay = std::fabs(n.y);
    const double az = std::fabs(n.z);
    std::vector<Point> flat;
    for (const Vec3d& p : points) {
        if (az >= ax && az >= ay)
            flat.push_back(n.z >= 0 ? Point{p.x, p.y} : Point{p.y, p.x});
        else if (ax >= ay)
            flat.push_back(n.x >= 0 ? Point{p.y, p.z} : Point{p.z, p.y});
        else
            flat.push_back(n.y >= 0 ? Point{p.z, p.x} : Point{p.x, p.z});
    }
    return flat;
}

// Cuts ears off the ring of what is left (Meisters, "Polygons have ears", 1975): the one with the
// shortest cut, for long polygons the first.
class EarClipper {
  public:
    explicit EarClipper(std::span<const Vec3f> corners)
        : corners_(corners), flat_(project(corners)), ring_(corners.size()) {
        std::iota(ring_.begin(), ring_.end(), Index{0});
    }

    std::vector<std::array<Index, 3>> clip() {
        std::vector<std::array<Index, 3>> triangles;
        while (ring_.size() > 3) {
            const std::size_t ear = choose_ear();
            triangles.push_back({before(ear), ring_[ear], after(ear)});
            ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(ear));
            start_ = ear == 0 ? 0 : ear - 1;
        }
        triangles.push_back({ring_[0], ring_[1], ring_[2]});
        return triangles;
    }

  private:
    // Comparing all ears costs the cube of the corners.
    static constexpr std::size_t kComparedCorners = 64;

    Index before(std::size_t i) const { return ring_[(i + ring_.size() - 1) % ring_.size()]; }
    Index after(std::size_t i) const { return ring_[(i + 1) % ring_.size()]; }

    bool coincide(Index a, Index b) const {
        return flat_[a].x == flat_[b].x && flat_[a].y == flat_[b].y;
    }

    // No other corner lies in the ear or on its border; corners that share a point with one of the
    // ear's (bridges to holes) do not count.
    bool is_clear(Index a, Index b, Index c) const {
        return std::none_of(ring_.begin(), ring_.end(), [&](Index other) {
            if (coincide(other, a) || coincide(other, b) || coincide(other, c)) return false;
            const Point& p = flat_[other];
            return doubled_area(flat_[a], flat_[b], p) >= 0 &&
                   doubled_area(flat_[b], flat_[c], p) >= 0 &&
                   doubled_area(flat_[c], flat_[a], p) >= 0;
        });
    }

    double cut_length(Index a, Index c) const {
        const Vec3f d = corners_[a] - corners_[c];
        return double{d.x} * d.x + double{d.y} * d.y + double{d.z} * d.z;
    }

    // Where nothing is an ear, the ring crosses itself or has no area: the fullest corner goes.
    std::size_t choose_ear() const {
        constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
        std::size_t ear = kNone;
        std::size_t fullest = 0;
        double fullest_area = -std::numeric_limits<double>::infinity();
        double shortest = std::numeric_limits<double>::infinity();
        for (std::size_t step = 0; step < ring_.size(); ++step) {
            const std::size_t i = (start_ + step) % ring_.size();
            const double area = doubled_area(flat_[before(i)], flat_[ring_[i]], flat_[after(i)]);
            if (area > fullest_area) {
                fullest_area = area;
                fullest = i;
            }
            const double cut = cut_length(before(i), after(i));
            if (!(area > 0) || !(cut < shortest) || !leaves_area(i)) continue;
            if (!is_clear(before(i), ring_[i], after(i))) continue;
            ear = i;
            shortest = cut;
            if (ring_.size() > kComparedCorners) break;
        }
        return ear == kNone ? fullest : ear;
    }

    // Of four corners the other triangle must not be a line or turned over.
    bool leaves_area(std::size_t i) const {
        if (ring_.size() != 4) return true;
        const Index opposite = ring_[(i + 2) % 4];
        return doubled_area(flat_[after(i)], flat_[opposite], flat_[before(i)]) > 0;
    }

    std::span<const Vec3f> corners_;
    std::vector<Point> flat_;
    std::vector<Index> ring_;
    std::size_t start_ = 0;
};

}  // namespace

std::vector<std::array<Index, 3>> triangulate(std::span<const Vec3f> corners) {
    if (corners.size() < 3) return {};
    return EarClipper(corners).clip();
}

}  // namespace penumbra
