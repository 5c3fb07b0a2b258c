#pragma once

#include "raster/snapped.h"

namespace penumbra::raster {

// Vertices [begin, end) of an instance; begin is a multiple of 16. Vertices are written in whole
// vectors: `snapped` has room for vertex_count rounded up to 16.
struct ProjectJob {
    Camera camera;
    const float* positions = nullptr;  // x y z of each vertex, world
    std::int32_t vertex_count = 0;
    std::int32_t begin = 0, end = 0;
    SnappedVertex* snapped = nullptr;
};

}  // namespace penumbra::raster

namespace penumbra::avx2 {
void project_vertices(const raster::ProjectJob& job);
}
namespace penumbra::avx512 {
void project_vertices(const raster::ProjectJob& job);
}
