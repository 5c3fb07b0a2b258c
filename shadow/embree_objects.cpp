#include "shadow/embree_objects.h"

#include <algorithm>
#include <string>

#include "core/error.h"

namespace penumbra::shadow {
namespace {

std::string configuration(TraceIsa isa) {
    // Embree accepts names it does not know without a word: they are checked in parse_trace_isa.
    const std::string isa_choice =
        isa == TraceIsa::kAuto ? "" : "isa=" + std::string(name(isa)) + ",";
    // No number of threads: that would be a limit for all of the process. Builds run in our arena.
    return isa_choice + "start_threads=0,set_affinity=0";
}

}  // namespace

void check(RTCDevice device, const char* action) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    const char* const reason =
        error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : "the ray tracer failed";
    throw OutputError(
        fmt::format("{} while {} (Embree error {})", reason, action, static_cast<int>(error)));
}

Device new_device(TraceIsa isa) {
    Device device(rtcNewDevice(configuration(isa).c_str()));
    if (!device) check(nullptr, "starting the ray tracer");
    return device;
}

Scene new_scene(RTCDevice device) {
    Scene scene(rtcNewScene(device));
    check(device, "creating the shadow rays' tree");
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
    return scene;
}

void commit(RTCDevice device, RTCScene scene, const parallel::Arena& arena) {
    // Not rtcJoinCommitScene: with TBB that one brings in threads of an arena of Embree's own.
    arena.run([scene] { rtcCommitScene(scene); });
    check(device, "building the shadow rays' tree");
}

Geometry new_triangles(RTCDevice device, const VertexSource& vertices,
                       std::span<const Triangle> triangles) {
    Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    if (vertices.has_room_behind) {
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   vertices.positions, 0, sizeof(Vec3f), vertices.count);
    } else {
        void* const copy =
            rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    sizeof(Vec3f), vertices.count);
        if (copy) std::copy_n(vertices.positions, vertices.count, static_cast<Vec3f*>(copy));
    }
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               triangles.data(), 0, sizeof(Triangle), triangles.size());
    return geometry;
}

void attach(RTCScene scene, const Geometry& geometry) {
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene, geometry.get());
}

}  // namespace penumbra::shadow
