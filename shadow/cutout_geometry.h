#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/scene/cutout.h"
#include "core/scene/scene_view.h"

// A mesh split into its opaque triangles and those with holes.

namespace penumbra::shadow {

struct CutoutGeometry {
    const Vec3f* positions = nullptr;  // as the rays see them
    const Vec2f* uvs = nullptr;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> maps_of_triangles;  // index into `maps`
    std::vector<CutoutMap> maps;

    // Is there a surface where the ray meets triangle `index`?
    [[nodiscard]] bool is_opaque_at(std::uint32_t index, const Vec3f& origin,
                                    const Vec3f& direction) const;
};

struct CutoutSplit {
    std::span<const Triangle> opaque;  // the mesh's own, if none has holes
    std::vector<Triangle> opaque_copy;
    CutoutGeometry cutout;
};

// Keeps pointers to the mesh, to `positions` and to the view's textures. Not movable once made,
// since `opaque` may point into it.
[[nodiscard]] std::unique_ptr<CutoutSplit> split_cutouts(const SceneView& view,
                                                         const Instance& instance,
                                                         const Vec3f* positions);

}  // namespace penumbra::shadow
