#pragma once

#include "core/frame/tile.h"

namespace penumbra {

inline constexpr std::uint32_t kNothing = 0xFFFFFFFFu;

// The nearest triangle at each pixel centre: what the rasterizer hands to the resolve.
struct VisibilityView {
    PlaneView<std::uint32_t> instance;  // index into SceneView::instances, or kNothing
    PlaneView<std::uint32_t> triangle;  // index into Mesh::triangles; kNothing where nothing is hit
};

}  // namespace penumbra
