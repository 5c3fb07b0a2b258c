#include "core/scene/merge_emitters.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "core/math/portable.h"
#include "core/scene/light_polygon.h"
#include "core/scene/polygon_soup.h"

namespace penumbra {
namespace {

using Index = std::uint32_t;
using Loop = std::vector<Index>;  // vertices around a polygon, those on straight edges included

// Off the common plane by at most this, in units of the polygon's extent.
constexpr double kMergeTolerance = 1e-5;
// A corner that turns by less, in radians, is on a straight edge.
constexpr double kStraightTolerance = 1e-5;
// Merging pair by pair stops at polygons of this many vertices: its cost is their square.
constexpr std::size_t kLongestLoop = 64;

std::uint64_t edge_key(Index from, Index to) {
    return (std::uint64_t{from} << 32) | to;
}

class Merger {
  public:
    Merger(const Mesh& mesh, std::span<const Index> triangles)
        : mesh_(mesh), welded_(weld(mesh.positions)) {
        for (const Index t : triangles) {
            const auto& v = mesh.triangles[t].vertex;
            add_face({welded_[v[0]], welded_[v[1]], welded_[v[2]]});
        }
    }

    std::vector<LightPolygon> merge() {
        std::vector<LightPolygon> result;
        std::vector<bool> done(faces_.size(), false);
        for (Index seed = 0; seed < faces_.size(); ++seed) {
            if (done[seed]) continue;
            const std::vector<Index> patch = coplanar_patch(seed, done);
            if (const auto whole = outline(patch); whole && is_convex(*whole)) {
                result.push_back(light_polygon(*whole));
            } else {
                merge_pairs(patch);
                for (const Index face : patch)
                    if (!faces_[face].empty()) result.push_back(light_polygon(faces_[face]));
            }
        }
        return result;
    }

  private:
    static constexpr Index kNobody = kNoIndex;

    void add_face(Loop loop) {
        const auto face = static_cast<Index>(faces_.size());
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint64_t key = edge_key(loop[i], loop[(i + 1) % loop.size()]);
            // An edge that two faces use in the same direction joins nothing.
            const auto [entry, is_new] = owners_.try_emplace(key, face);
            if (!is_new) entry->second = kNobody;
        }
        faces_.push_back(std::move(loop));
    }

    Vec3d position(Index vertex) const {
        const Vec3f& p = mesh_.positions[vertex];
        return {p.x, p.y, p.z};
    }
    std::vector<Vec3d> positions(const Loop& loop) const {
        std::vector<Vec3d> result;
        for (const Index v : loop) result.push_back(position(v));
        return result;
    }
    Index across(Index from, Index to) const {
        const auto found = owners_.find(edge_key(to, from));
        return found == owners_.end() ? kNobody : found->second;
    }

    // Do all vertices of the loop lie in the plane, and does it face the same way?
    bool lies_in_plane(const Loop& loop, const Vec3d& origin, const Vec3d& normal) const {
        const std::vector<Vec3d> points = positions(loop);
        double extent = 0;
        double distance = 0;
        double magnitude = length(origin);
        for (const Vec3d& p : points) {
            extent = std::max(extent, length(p - points[0]));
            distance = std::max(distance, std::fabs(dot(p - origin, normal)));
            magnitude = std::max(magnitude, length(p));
        }
        // What the rounding of the coordinates to float may add.
        const double rounding = magnitude * 0x1p-23;
        return distance <= kMergeTolerance * extent + rounding &&
               dot(newell_normal(points), normal) > 0;
    }

    // The faces reachable over shared edges within the seed's plane, the seed first; marks them
    // done.
    std::vector<Index> coplanar_patch(Index seed, std::vector<bool>& done) const {
        const Vec3d normal = normalize(newell_normal(positions(faces_[seed])));
        const Vec3d origin = position(faces_[seed][0]);
        std::vector<Index> patch{seed};
        done[seed] = true;
        for (std::size_t at = 0; at < patch.size(); ++at) {
            const Loop& loop = faces_[patch[at]];
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Index next = across(loop[i], loop[(i + 1) % loop.size()]);
                if (next == kNobody || done[next] || !lies_in_plane(faces_[next], origin, normal))
                    continue;
                done[next] = true;
                patch.push_back(next);
            }
        }
        std::sort(patch.begin(), patch.end());
        return patch;
    }

    // The border of the union, if it is one loop that touches itself nowhere.
    std::optional<Loop> outline(const std::vector<Index>& patch) const {
        std::unordered_map<std::uint64_t, bool> edges;
        for (const Index face : patch) {
            const Loop& loop = faces_[face];
            for (std::size_t i = 0; i < loop.size(); ++i)
                if (!edges.emplace(edge_key(loop[i], loop[(i + 1) % loop.size()]), true).second)
                    return std::nullopt;
        }
        std::unordered_map<Index, Index> next;
        std::optional<Index> start;
        for (const Index face : patch) {
            const Loop& loop = faces_[face];
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Index from = loop[i];
                const Index to = loop[(i + 1) % loop.size()];
                if (edges.contains(edge_key(to, from))) continue;
                if (!next.emplace(from, to).second) return std::nullopt;
                if (!start) start = from;
            }
        }
        if (!start) return std::nullopt;
        Loop loop{*start};
        for (Index at = next.at(*start); at != *start; at = next.at(at)) {
            loop.push_back(at);
            if (loop.size() > next.size() || !next.contains(at)) return std::nullopt;
        }
        if (loop.size() != next.size()) return std::nullopt;
        return loop;
    }

    Loop without_straight_corners(const Loop& loop) const {
        Loop corners;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec3d here = position(loop[i]);
            const Vec3d in = here - position(loop[(i + loop.size() - 1) % loop.size()]);
            const Vec3d out = position(loop[(i + 1) % loop.size()]) - here;
            const double turn = portable::atan2(length(cross(in, out)), dot(in, out));
            if (turn > kStraightTolerance) corners.push_back(loop[i]);
        }
        return corners;
    }

    bool is_convex(const Loop& loop) const {
        const Loop corners = without_straight_corners(loop);
        if (corners.size() < 3 || corners.size() > kMaxLightVertices) return false;
        const std::vector<Vec3d> points = positions(corners);
        const Vec3d normal = newell_normal(points);
        double turned = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec3d in = points[i] - points[(i + points.size() - 1) % points.size()];
            const Vec3d out = points[(i + 1) % points.size()] - points[i];
            const double sine = dot(cross(in, out), normal);
            if (!(sine > 0)) return false;
            turned += portable::atan2(length(cross(in, out)), dot(in, out));
        }
        return turned < 7;  // 2 pi; a star turns further
    }

    // Joins pairs until none is left that makes a convex polygon. A joined face becomes empty.
    void merge_pairs(const std::vector<Index>& patch) {
        bool changed = true;
        while (changed) {
            changed = false;
            for (const Index face : patch)
                while (!faces_[face].empty() && join_a_neighbour(face)) changed = true;
        }
    }

    bool join_a_neighbour(Index face) {
        const Loop loop = faces_[face];
        const Vec3d origin = position(loop[0]);
        const Vec3d normal = normalize(newell_normal(positions(loop)));
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Index other = across(loop[i], loop[(i + 1) % loop.size()]);
            if (other == kNobody || other == face) continue;
            if (loop.size() + faces_[other].size() > kLongestLoop) continue;
            if (!lies_in_plane(faces_[other], origin, normal)) continue;
            const auto joined = outline({face, other});
            if (!joined || !is_convex(*joined)) continue;
            const Loop& gone = faces_[other];
            for (std::size_t k = 0; k < gone.size(); ++k) {
                Index& owner = owners_.at(edge_key(gone[k], gone[(k + 1) % gone.size()]));
                if (owner == other) owner = face;
            }
            faces_[other].clear();
            faces_[face] = *joined;
            return true;
        }
        return false;
    }

    LightPolygon light_polygon(const Loop& loop) const {
        Loop corners = without_straight_corners(loop);
        if (corners.size() < 3) corners = loop;  // a needle
        LightPolygon polygon;
        for (const Index v : corners)
            polygon.vertices[static_cast<std::size_t>(polygon.vertex_count++)] = mesh_.positions[v];
        return polygon;
    }

    const Mesh& mesh_;
    std::vector<Index> welded_;
    std::vector<Loop> faces_;
    std::unordered_map<std::uint64_t, Index> owners_;  // of directed edges; never iterated
};

}  // namespace

std::vector<LightPolygon> merge_emitters(const Mesh& mesh, std::span<const Index> triangles) {
    return Merger(mesh, triangles).merge();
}

}  // namespace penumbra
