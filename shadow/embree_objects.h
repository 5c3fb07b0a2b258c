#pragma once

#include <memory>
#include <span>

#include "core/math/vec.h"
#include "core/parallel/arena.h"
#include "core/scene/scene.h"
#include "shadow/embree.h"
#include "shadow/trace_isa.h"

// Embree's objects, released when their owner goes. For sources of this folder.

namespace penumbra::shadow {

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using Scene = std::unique_ptr<RTCSceneTy, ReleaseScene>;
using Geometry = std::unique_ptr<RTCGeometryTy, ReleaseGeometry>;

// Throws OutputError if something went wrong on the device since the last call.
void check(RTCDevice device, const char* action);

// One without threads of its own.
[[nodiscard]] Device new_device(TraceIsa isa);

// A tree to be filled: robust, of medium quality.
[[nodiscard]] Scene new_scene(RTCDevice device);

// Builds it, on the arena's threads.
void commit(RTCDevice device, RTCScene scene, const parallel::Arena& arena);

struct VertexSource {
    const Vec3f* positions;
    std::size_t count;
    bool has_room_behind;  // may 16 bytes be read at the last vertex? If not, they are copied
};
// Refers to both for as long as it lives.
[[nodiscard]] Geometry new_triangles(RTCDevice device, const VertexSource& vertices,
                                     std::span<const Triangle> triangles);

void attach(RTCScene scene, const Geometry& geometry);

}  // namespace penumbra::shadow
