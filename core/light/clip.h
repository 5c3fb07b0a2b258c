#pragma once

#include "core/light/polygon_shape.h"

// A convex polygon clipped to the half-space above a shading point's horizon.

namespace penumbra {

inline constexpr int kMaxClippedVertices = kMaxPolygonVertices + 2;  // room for two clips in a row

// Every lane has the same number of slots, one more than the polygon had vertices. Lanes that need
// fewer repeat a vertex, bit for bit: an edge between equal slots is no edge. Slots keep the
// polygon's winding; the polygon stays closed from the last slot to the first.
template <class F>
struct ClippedPolygon {
    int count = 0;                          // slots in use, the same for all lanes
    Vec3<F> vertices[kMaxClippedVertices];  // z >= 0; zero where not `visible`
    F heights[kMaxClippedVertices];         // exactly 0 where the polygon was cut
    simd::MaskOf<F> visible;                // some part lies above the horizon, not only on it
};

namespace detail {

// Where the edge from `inside` (height >= 0) to `outside` (height < 0) meets height 0. Exactly
// `inside` if that vertex touches the horizon.
template <class F>
Vec3<F> horizon_crossing(const Vec3<F>& inside, F inside_height, const Vec3<F>& outside,
                         F outside_height) {
    const F span = inside_height - outside_height;
    const F t = inside_height / simd::select(span > F(0), span, F(1));
    return fma(outside - inside, t, inside);
}

// The two crossings of a convex polygon: `leaving` the half-space and `entering` it again.
template <class F>
struct HorizonCrossings {
    Vec3<F> leaving, entering;
};

template <class F>
HorizonCrossings<F> horizon_crossings(const Vec3<F>* vertices, const F* heights, int count) {
    Vec3<F> last_inside = vertices[0], first_outside = vertices[0];
    Vec3<F> last_outside = vertices[0], first_inside = vertices[0];
    F last_inside_height = F(0), first_outside_height = F(0);
    F last_outside_height = F(0), first_inside_height = F(0);
    for (int i = 0; i < count; ++i) {
        const int next = i + 1 < count ? i + 1 : 0;
        const auto below = heights[i] < F(0);
        const auto next_below = heights[next] < F(0);
        const auto leaves = (!below) & next_below;
        const auto enters = below & (!next_below);
        last_inside = select(leaves, vertices[i], last_inside);
        first_outside = select(leaves, vertices[next], first_outside);
        last_inside_height = simd::select(leaves, heights[i], last_inside_height);
        first_outside_height = simd::select(leaves, heights[next], first_outside_height);
        last_outside = select(enters, vertices[i], last_outside);
        first_inside = select(enters, vertices[next], first_inside);
        last_outside_height = simd::select(enters, heights[i], last_outside_height);
        first_inside_height = simd::select(enters, heights[next], first_inside_height);
    }
    return {horizon_crossing(last_inside, last_inside_height, first_outside, first_outside_height),
            horizon_crossing(first_inside, first_inside_height, last_outside, last_outside_height)};
}

}  // namespace detail

// Clips by arbitrary heights above a plane, linear in the vertices (`heights[i]` belongs to
// `vertices[i]`). count <= kMaxClippedVertices - 1. A vertex of height 0 is inside. Sutherland and
// Hodgman, "Reentrant Polygon Clipping" (1974), for one plane and a convex polygon: the vertices
// below collapse into the crossing where the boundary leaves, and the crossing where it enters is
// inserted behind them, which moves what follows by one slot.
template <class F>
void clip_by_heights(const Vec3<F>* vertices, const F* heights, int count,
                     ClippedPolygon<F>& clipped) {
    const detail::HorizonCrossings<F> crossings =
        detail::horizon_crossings(vertices, heights, count);
    const Vec3<F> zero{F(0), F(0), F(0)};
    F highest = heights[0];
    for (int i = 1; i < count; ++i) highest = simd::max(highest, heights[i]);

    clipped.count = count + 1;
    clipped.visible = highest > F(0);
    Vec3<F> previous = zero;
    F previous_height = F(0);
    auto previous_below = heights[0] < heights[0];  // no lane
    auto shifted = previous_below;
    for (int i = 0; i <= count; ++i) {
        const int here = i < count ? i : 0;
        const auto below = heights[here] < F(0);
        // Without a cut, the slot behind the last vertex repeats it.
        const auto take_previous = i < count ? shifted : (!previous_below) | shifted;
        const auto enters = previous_below & (!below);
        Vec3<F> current = select(below, crossings.leaving, vertices[here]);
        F current_height = simd::select(below, F(0), heights[here]);
        Vec3<F> slot = select(take_previous, previous, current);
        F slot_height = simd::select(take_previous, previous_height, current_height);
        slot = select(enters, crossings.entering, slot);
        slot_height = simd::select(enters, F(0), slot_height);
        clipped.vertices[i] = select(clipped.visible, slot, zero);
        clipped.heights[i] = simd::select(clipped.visible, slot_height, F(0));
        shifted = shifted | enters;
        previous = current;
        previous_height = current_height;
        previous_below = below;
    }
}

// Clips to z >= 0: vertices are relative to the shading point, in a frame whose z axis is its
// normal. Cut vertices have z = 0 exactly.
template <class F>
ClippedPolygon<F> clip_to_horizon(const Vec3<F>* vertices, int count) {
    F heights[kMaxClippedVertices];
    for (int i = 0; i < count; ++i) heights[i] = vertices[i].z;
    ClippedPolygon<F> clipped;
    clip_by_heights(vertices, heights, count, clipped);
    for (int i = 0; i < clipped.count; ++i) clipped.vertices[i].z = clipped.heights[i];
    return clipped;
}

}  // namespace penumbra
