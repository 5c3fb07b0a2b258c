// Rays against a tree of boxes over triangles, lanes over rays as long as enough of them stay
// together, then one by one with lanes over boxes and over triangles.
//
// The answer for a ray is whether any triangle meets it (segment_triangle.h), which is defined in
// real numbers. It depends neither on the tree, nor on the order of the visits, nor on this file's
// rounding, as long as no box is left out that the segment passes through. A plane of a box is
// crossed at t = (plane - origin) / direction. Computed as (plane - origin) * (1 / direction) it
// errs by three roundings, a factor of at most 1 + 3.01 * 2^-24 up or down; nothing underflows,
// since boxes reach 2^-90 beyond their triangles and differences are 0 or above that, but for t
// itself. With the exact values entry <= exit holds for the boxes passed through, hence with the
// computed ones entry <= exit * (1 + 2^-21) + 2^-100. Components of a direction below 2^-120 count
// as 2^-120: up to t = 2^20 both move by less than 2^-100, within the boxes' padding of 2^-90, and
// the padding of a unit in the last place keeps origins on a triangle's plane inside. After Ize,
// "Robust BVH Ray Traversal" (2013). Differs: no rounding to neighbours, one factor for all.

#include "shadow/occlude_kernel.h"

#include <limits>

#include "core/simd/kernel.h"
#include "shadow/segment_triangle.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

using shadow::kTreeWidth;
using shadow::TreeLeaf;
using shadow::TreeNode;
using shadow::TreeReference;

// One ray with lanes over boxes or triangles: kTreeWidth of them on every processor.
using Wide = simd::Float<simd::Avx2>;
static_assert(simd::kLanes<Wide> == kTreeWidth);

constexpr float kExitFactor = 1 + 0x1p-21f;
constexpr float kExitMargin = 0x1p-100f;
constexpr float kSmallestComponent = 0x1p-120f;

// At most this many rays of a packet go on one by one.
constexpr int kFewRays = kLanes / 8;

// A packet of rays, and what is computed of them once.
struct Packet {
    alignas(64) float origin[3][kLanes];
    alignas(64) float direction[3][kLanes];
    alignas(64) float reciprocal[3][kLanes];
    alignas(64) float near_limit[kLanes];
    alignas(64) float far_limit[kLanes];
    // Of the ray's sheared frame (ShearedSegment).
    alignas(64) float shear_x[kLanes];
    alignas(64) float shear_y[kLanes];
    alignas(64) float low[kLanes];
    alignas(64) float high[kLanes];
    alignas(64) std::int32_t axis[kLanes];
    bool has_one_axis;
};

template <class V>
V by_axis(const M& is_x, const M& is_y, V x, V y, V z) {
    return simd::select(is_x, x, simd::select(is_y, y, z));
}

void set_up_frames(const F (&d)[3], F near_limit, F far_limit, std::uint32_t active, Packet& p) {
    const F x = simd::abs(d[0]), y = simd::abs(d[1]), z = simd::abs(d[2]);
    const M is_x = (x > y) & (x > z);
    const M is_y = (!is_x) & (y > z);
    const F along = by_axis(is_x, is_y, d[0], d[1], d[2]);
    const F end_0 = near_limit * along, end_1 = far_limit * along;
    simd::store(p.shear_x, by_axis(is_x, is_y, d[1], d[2], d[0]) / along);
    simd::store(p.shear_y, by_axis(is_x, is_y, d[2], d[0], d[1]) / along);
    simd::store(p.low, simd::min(end_0, end_1));
    simd::store(p.high, simd::max(end_0, end_1));
    simd::store(p.axis, by_axis(is_x, is_y, I(0), I(1), I(2)));
    const std::uint32_t x_bits = simd::bits(is_x) & active, y_bits = simd::bits(is_y) & active;
    p.has_one_axis = x_bits == active || y_bits == active || (x_bits | y_bits) == 0;
}

void set_up(const shadow::RayStream& rays, int first, std::uint32_t active, Packet& p) {
    F direction[3];
    for (int axis = 0; axis < 3; ++axis) {
        direction[axis] = simd::load<F>(rays.direction[axis] + first);
        const F magnitude = simd::max(simd::abs(direction[axis]), F(kSmallestComponent));
        simd::store(p.origin[axis], simd::load<F>(rays.origin[axis] + first));
        simd::store(p.direction[axis], direction[axis]);
        simd::store(p.reciprocal[axis], F(1) / simd::copysign(magnitude, direction[axis]));
    }
    const F near_limit = simd::load<F>(rays.near_limit + first);
    const F far_limit = simd::load<F>(rays.far_limit + first);
    simd::store(p.near_limit, near_limit);
    simd::store(p.far_limit, far_limit);
    set_up_frames(direction, near_limit, far_limit, active, p);
}

// ---- triangles ----------------------------------------------------------------------------------

Vec3f vertex(const TreeLeaf& leaf, int triangle, int index) {
    const auto& v = leaf.vertices[index];
    return {v[0][triangle], v[1][triangle], v[2][triangle]};
}

Vec3f vector(const float (&planes)[3][kLanes], int ray) {
    return {planes[0][ray], planes[1][ray], planes[2][ray]};
}

// What the first look has left open.
bool meets(const TreeLeaf& leaf, int triangle, const Packet& p, int ray) {
    const Vec3f vertices[3] = {vertex(leaf, triangle, 0), vertex(leaf, triangle, 1),
                               vertex(leaf, triangle, 2)};
    return shadow::meets(
        {vector(p.origin, ray), vector(p.direction, ray), p.near_limit[ray], p.far_limit[ray]},
        vertices);
}

bool is_opaque(const TreeLeaf& leaf, int triangle, const Packet& p, int ray) {
    const shadow::CutoutTriangle* const cutout = leaf.cutouts[triangle];
    if (cutout == nullptr) return true;
    const Vec3f(&v)[3] = cutout->positions;
    return penumbra::is_opaque<float>(*cutout->map,
                                      relative_triangle(vector(p.origin, ray), v[0], v[1], v[2]),
                                      cutout->uvs, vector(p.direction, ray));
}

bool is_blocked_by_any(const TreeLeaf& leaf, std::uint32_t met, std::uint32_t open, const Packet& p,
                       int ray) {
    if (!leaf.has_cutouts && met != 0) return true;
    for (std::uint32_t rest = met | open; rest != 0; rest &= rest - 1) {
        const int triangle = __builtin_ctz(rest);
        const bool is_met = ((met >> triangle) & 1u) != 0 || meets(leaf, triangle, p, ray);
        if (is_met && is_opaque(leaf, triangle, p, ray)) return true;
    }
    return false;
}

bool is_blocked(const TreeLeaf& leaf, const Packet& p, int ray) {
    const int axes[3] = {(p.axis[ray] + 1) % 3, (p.axis[ray] + 2) % 3, p.axis[ray]};
    const shadow::ShearedSegment<Wide> segment = {
        {Wide(p.origin[axes[0]][ray]), Wide(p.origin[axes[1]][ray]), Wide(p.origin[axes[2]][ray])},
        Wide(p.shear_x[ray]),
        Wide(p.shear_y[ray]),
        Wide(p.low[ray]),
        Wide(p.high[ray])};
    Vec3<Wide> vertices[3];
    for (int i = 0; i < 3; ++i)
        vertices[i] = {simd::load<Wide>(leaf.vertices[i][axes[0]]),
                       simd::load<Wide>(leaf.vertices[i][axes[1]]),
                       simd::load<Wide>(leaf.vertices[i][axes[2]])};
    const shadow::Verdict<Wide> verdict = shadow::first_look(segment, vertices);
    return is_blocked_by_any(leaf, simd::bits(verdict.meets),
                             ~simd::bits(verdict.misses | verdict.meets) & ((1u << kTreeWidth) - 1),
                             p, ray);
}

std::uint32_t blocked_one_by_one(const TreeLeaf& leaf, const Packet& p, std::uint32_t active) {
    std::uint32_t blocked = 0;
    for (std::uint32_t rest = active; rest != 0; rest &= rest - 1) {
        const int ray = __builtin_ctz(rest);
        if (is_blocked(leaf, p, ray)) blocked |= 1u << ray;
    }
    return blocked;
}

// Lanes over rays that share their sheared frame's axes.
std::uint32_t blocked_together(const TreeLeaf& leaf, const Packet& p, std::uint32_t active) {
    const int axis = p.axis[__builtin_ctz(active)];
    const int axes[3] = {(axis + 1) % 3, (axis + 2) % 3, axis};
    const shadow::ShearedSegment<F> segment = {
        {simd::load<F>(p.origin[axes[0]]), simd::load<F>(p.origin[axes[1]]),
         simd::load<F>(p.origin[axes[2]])},
        simd::load<F>(p.shear_x),
        simd::load<F>(p.shear_y),
        simd::load<F>(p.low),
        simd::load<F>(p.high)};
    std::uint32_t blocked = 0;
    for (int triangle = 0; triangle < leaf.count; ++triangle) {
        Vec3<F> vertices[3];
        for (int i = 0; i < 3; ++i)
            vertices[i] = {F(leaf.vertices[i][axes[0]][triangle]),
                           F(leaf.vertices[i][axes[1]][triangle]),
                           F(leaf.vertices[i][axes[2]][triangle])};
        const shadow::Verdict<F> verdict = shadow::first_look(segment, vertices);
        blocked |= simd::bits(verdict.meets) & active;
        std::uint32_t open = ~simd::bits(verdict.misses) & active & ~blocked;
        for (; open != 0; open &= open - 1)
            if (meets(leaf, triangle, p, __builtin_ctz(open))) blocked |= open & -open;
        if (blocked == active) break;
    }
    return blocked;
}

// ---- boxes --------------------------------------------------------------------------------------

// Of `kTreeWidth` boxes, those that one ray passes through.
std::uint32_t boxes_passed(const TreeNode& node, const Packet& p, int ray) {
    Wide entry(p.near_limit[ray]), exit(p.far_limit[ray]);
    for (int axis = 0; axis < 3; ++axis) {
        const Wide origin(p.origin[axis][ray]), reciprocal(p.reciprocal[axis][ray]);
        const int first = p.reciprocal[axis][ray] < 0 ? 1 : 0;
        entry =
            simd::max(entry, (simd::load<Wide>(node.bounds[first][axis]) - origin) * reciprocal);
        exit =
            simd::min(exit, (simd::load<Wide>(node.bounds[1 - first][axis]) - origin) * reciprocal);
    }
    return simd::bits(entry <= simd::fma(exit, Wide(kExitFactor), Wide(kExitMargin)));
}

struct PacketLanes {
    F origin[3], reciprocal[3], near_limit, far_limit;
    // The side of a box at which all active rays enter along each axis: TreeNode::bounds[side].
    // Meaningful if they go the same way.
    int entry_side[3];
    bool have_one_octant;
};

F crossing(const TreeNode& node, int side, int axis, int child, const PacketLanes& p) {
    return (F(node.bounds[side][axis][child]) - p.origin[axis]) * p.reciprocal[axis];
}

// Of a packet's rays, those that pass through one box.
template <bool kOneOctant>
std::uint32_t rays_inside(const TreeNode& node, int child, const PacketLanes& p) {
    F entry = p.near_limit, exit = p.far_limit;
    for (int axis = 0; axis < 3; ++axis) {
        const int side = kOneOctant ? p.entry_side[axis] : 0;
        const F first = crossing(node, side, axis, child, p);
        const F second = crossing(node, 1 - side, axis, child, p);
        entry = simd::max(entry, kOneOctant ? first : simd::min(first, second));
        exit = simd::min(exit, kOneOctant ? second : simd::max(first, second));
    }
    return simd::bits(entry <= simd::fma(exit, F(kExitFactor), F(kExitMargin)));
}

// ---- the tree -----------------------------------------------------------------------------------

constexpr int kStackSize = shadow::kMaxTreeDepth * (kTreeWidth - 1) + 1;

bool is_blocked_below(TreeReference from, const Packet& p, int ray) {
    TreeReference stack[kStackSize];
    int height = 0;
    stack[height++] = from;
    while (height > 0) {
        const TreeReference top = stack[--height];
        if (top.is_leaf()) {
            if (is_blocked(top.leaf(), p, ray)) return true;
            continue;
        }
        const TreeNode& node = top.node();
        for (std::uint32_t rest = boxes_passed(node, p, ray); rest != 0; rest &= rest - 1)
            stack[height++] = node.children[__builtin_ctz(rest)];
    }
    return false;
}

std::uint32_t blocked_below_one_by_one(TreeReference from, const Packet& p, std::uint32_t active) {
    std::uint32_t blocked = 0;
    for (std::uint32_t rest = active; rest != 0; rest &= rest - 1) {
        const int ray = __builtin_ctz(rest);
        if (is_blocked_below(from, p, ray)) blocked |= 1u << ray;
    }
    return blocked;
}

struct Visit {
    TreeReference what;
    std::uint32_t rays;
};

template <bool kOneOctant>
int push_children(const TreeNode& node, const PacketLanes& lanes, std::uint32_t active,
                  Visit* stack) {
    int pushed = 0;
    for (int child = 0; child < kTreeWidth && !node.children[child].is_null(); ++child) {
        const std::uint32_t inside = rays_inside<kOneOctant>(node, child, lanes) & active;
        if (inside != 0) stack[pushed++] = {node.children[child], inside};
    }
    return pushed;
}

PacketLanes lanes_of(const Packet& p, std::uint32_t active) {
    PacketLanes lanes;
    lanes.have_one_octant = true;
    for (int axis = 0; axis < 3; ++axis) {
        lanes.origin[axis] = simd::load<F>(p.origin[axis]);
        lanes.reciprocal[axis] = simd::load<F>(p.reciprocal[axis]);
        const std::uint32_t backward = simd::bits(lanes.reciprocal[axis] < F(0)) & active;
        lanes.entry_side[axis] = backward != 0 ? 1 : 0;
        lanes.have_one_octant &= backward == 0 || backward == active;
    }
    lanes.near_limit = simd::load<F>(p.near_limit);
    lanes.far_limit = simd::load<F>(p.far_limit);
    return lanes;
}

std::uint32_t blocked_rays(TreeReference root, const Packet& p, std::uint32_t all) {
    const PacketLanes lanes = lanes_of(p, all);
    Visit stack[kStackSize];
    int height = 0;
    stack[height++] = {root, all};
    std::uint32_t blocked = 0;
    while (height > 0) {
        const Visit top = stack[--height];
        const std::uint32_t active = top.rays & ~blocked;
        if (active == 0) continue;
        if (__builtin_popcount(active) <= kFewRays)
            blocked |= blocked_below_one_by_one(top.what, p, active);
        else if (!top.what.is_leaf())
            height += lanes.have_one_octant
                          ? push_children<true>(top.what.node(), lanes, active, stack + height)
                          : push_children<false>(top.what.node(), lanes, active, stack + height);
        else if (p.has_one_axis && !top.what.leaf().has_cutouts)
            blocked |= blocked_together(top.what.leaf(), p, active);
        else
            blocked |= blocked_one_by_one(top.what.leaf(), p, active);
    }
    return blocked;
}

}  // namespace

void occlude(TreeReference tree, const shadow::RayStream& rays) {
    constexpr float kBlocked = -std::numeric_limits<float>::infinity();
    for (int first = 0; first < rays.count; first += kLanes) {
        const int count = rays.count - first < kLanes ? rays.count - first : kLanes;
        std::uint32_t active = (1u << count) - 1;
        for (int ray = 0; ray < count; ++ray)  // by an earlier tree
            if (rays.far_limit[first + ray] < 0) active &= ~(1u << ray);
        if (active == 0) continue;
        Packet packet;
        set_up(rays, first, active, packet);
        for (std::uint32_t rest = blocked_rays(tree, packet, active); rest != 0; rest &= rest - 1)
            rays.far_limit[first + __builtin_ctz(rest)] = kBlocked;
    }
}

}  // namespace penumbra::PENUMBRA_ISA
