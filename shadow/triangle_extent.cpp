#include "shadow/triangle_extent.h"

#include <algorithm>
#include <vector>

namespace penumbra::shadow {
namespace {

float largest(const Vec3f& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

TriangleExtents extents_of(const Mesh& mesh, const Vec3f* positions, std::size_t begin,
                           std::size_t end) {
    TriangleExtents extents;
    for (std::size_t i = begin; i < end; ++i) {
        const auto& [a, b, c] = mesh.triangles[i].vertex;
        const Vec3f &p = positions[a], &q = positions[b], &r = positions[c];
        extents.edge = std::max({extents.edge, largest(q - p), largest(r - q), largest(p - r)});
        extents.coordinate = std::max({extents.coordinate, largest(p), largest(q), largest(r)});
    }
    return extents;
}

// The largest factor by which a transform stretches an axis, times three for the sum over axes.
float stretch(const Affine3f& transform) {
    return largest(transform.column_x) + largest(transform.column_y) + largest(transform.column_z);
}

}  // namespace

TriangleExtents triangle_extents(const parallel::Arena& arena, const Instance& instance) {
    constexpr std::size_t kTrianglesPerTask = 1 << 16;
    const Mesh& mesh = *instance.mesh;
    const Vec3f* const positions =
        instance.is_animated ? mesh.positions.data() : instance.positions.data();
    const std::size_t tasks = (mesh.triangles.size() + kTrianglesPerTask - 1) / kTrianglesPerTask;
    std::vector<TriangleExtents> parts(tasks);
    arena.for_each(static_cast<int>(tasks), [&](int task, int) {
        const std::size_t begin = static_cast<std::size_t>(task) * kTrianglesPerTask;
        const std::size_t end = std::min(begin + kTrianglesPerTask, mesh.triangles.size());
        parts[static_cast<std::size_t>(task)] = extents_of(mesh, positions, begin, end);
    });
    TriangleExtents extents;
    for (const TriangleExtents& part : parts) {
        extents.edge = std::max(extents.edge, part.edge);
        extents.coordinate = std::max(extents.coordinate, part.coordinate);
    }
    return extents;
}

float offset_scale(const TriangleExtents& extents, const Instance& instance) {
    if (!instance.is_animated) return extents.edge;
    const Affine3f& transform = instance.world_from_object;
    const float instanced =
        stretch(transform) * extents.coordinate + largest(transform.translation);
    return std::max(instanced, stretch(transform) * extents.edge);
}

}  // namespace penumbra::shadow
