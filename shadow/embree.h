#pragma once

// Embree, whichever is installed: the newer where both are, as cmake/Embree.cmake decides, too.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>

#include "shadow/ray_stream.h"

// What differs between Embree 3 and 4, in the words of neither: 3 has streams of rays, which 4
// traces in packets of 16. For sources of this folder and for tests; no header that others include
// shows it.

namespace penumbra::embree {

inline constexpr bool kHasStreams = RTC_VERSION_MAJOR < 4;

enum class Order { kCoherent, kIncoherent };

#if RTC_VERSION_MAJOR >= 4

// What rays are traced with; may be used again and again, by one thread.
struct Query {
    RTCOccludedArguments occluded;
    RTCIntersectArguments intersect;

    explicit Query(Order order) {
        rtcInitOccludedArguments(&occluded);
        rtcInitIntersectArguments(&intersect);
        occluded.flags = intersect.flags =
            order == Order::kCoherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    }
};

// A lane is traced where `valid` is -1. The far limit of a blocked ray becomes -infinity.
inline void occlude(RTCScene scene, Query& query, RTCRay& ray) {
    rtcOccluded1(scene, &ray, &query.occluded);
}
inline void occlude(RTCScene scene, Query& query, const int* valid, RTCRay8& rays) {
    rtcOccluded8(valid, scene, &rays, &query.occluded);
}
inline void occlude(RTCScene scene, Query& query, const int* valid, RTCRay16& rays) {
    rtcOccluded16(valid, scene, &rays, &query.occluded);
}
inline void intersect(RTCScene scene, Query& query, RTCRayHit& ray) {
    rtcIntersect1(scene, &ray, &query.intersect);
}
inline void intersect(RTCScene scene, Query& query, const int* valid, RTCRayHit8& rays) {
    rtcIntersect8(valid, scene, &rays, &query.intersect);
}
inline void intersect(RTCScene scene, Query& query, const int* valid, RTCRayHit16& rays) {
    rtcIntersect16(valid, scene, &rays, &query.intersect);
}

// In the last packet, the lanes behind the last ray are not traced.
inline void occlude(RTCScene scene, Query& query, const shadow::RayStream& rays) {
    constexpr int kPacket = 16;
    for (int first = 0; first < rays.count; first += kPacket) {
        RTCRay16 packet{};
        alignas(64) int valid[kPacket];
        for (int i = 0; i < kPacket; ++i) valid[i] = first + i < rays.count ? -1 : 0;
        std::copy_n(rays.origin[0] + first, kPacket, packet.org_x);
        std::copy_n(rays.origin[1] + first, kPacket, packet.org_y);
        std::copy_n(rays.origin[2] + first, kPacket, packet.org_z);
        std::copy_n(rays.direction[0] + first, kPacket, packet.dir_x);
        std::copy_n(rays.direction[1] + first, kPacket, packet.dir_y);
        std::copy_n(rays.direction[2] + first, kPacket, packet.dir_z);
        std::copy_n(rays.near_limit + first, kPacket, packet.tnear);
        std::copy_n(rays.far_limit + first, kPacket, packet.tfar);
        std::fill_n(packet.mask, kPacket, 0xFFFFFFFFu);
        occlude(scene, query, valid, packet);
        std::copy_n(packet.tfar, kPacket, rays.far_limit + first);
    }
}

#else

// What rays are traced with; may be used again and again, by one thread.
struct Query {
    RTCIntersectContext context;

    explicit Query(Order order) {
        rtcInitIntersectContext(&context);
        context.flags = order == Order::kCoherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                  : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    }
};

// A lane is traced where `valid` is -1. The far limit of a blocked ray becomes -infinity.
inline void occlude(RTCScene scene, Query& query, RTCRay& ray) {
    rtcOccluded1(scene, &query.context, &ray);
}
inline void occlude(RTCScene scene, Query& query, const int* valid, RTCRay8& rays) {
    rtcOccluded8(valid, scene, &query.context, &rays);
}
inline void occlude(RTCScene scene, Query& query, const int* valid, RTCRay16& rays) {
    rtcOccluded16(valid, scene, &query.context, &rays);
}
inline void intersect(RTCScene scene, Query& query, RTCRayHit& ray) {
    rtcIntersect1(scene, &query.context, &ray);
}
inline void intersect(RTCScene scene, Query& query, const int* valid, RTCRayHit8& rays) {
    rtcIntersect8(valid, scene, &query.context, &rays);
}
inline void intersect(RTCScene scene, Query& query, const int* valid, RTCRayHit16& rays) {
    rtcIntersect16(valid, scene, &query.context, &rays);
}

// As one stream: fewer calls than packets, and Embree gathers what its own width needs.
inline void occlude(RTCScene scene, Query& query, const shadow::RayStream& rays) {
    RTCRayNp stream{};
    stream.org_x = rays.origin[0];
    stream.org_y = rays.origin[1];
    stream.org_z = rays.origin[2];
    stream.dir_x = rays.direction[0];
    stream.dir_y = rays.direction[1];
    stream.dir_z = rays.direction[2];
    stream.tnear = rays.near_limit;
    stream.tfar = rays.far_limit;
    rtcOccludedNp(scene, &query.context, &stream, static_cast<unsigned>(rays.count));
}

#endif

}  // namespace penumbra::embree
