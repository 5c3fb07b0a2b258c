#include "tests/benchmarks/bare_embree.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>

#include "core/profile/stopwatch.h"

namespace penumbra::benchmarks {
namespace {

alignas(64) constexpr int kAllValid[16] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                           -1, -1, -1, -1, -1, -1, -1, -1};

void attach(RTCDevice device, RTCScene scene, const Instance& instance) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t vertices = instance.mesh->positions.size();
    const std::size_t triangles = instance.mesh->triangles.size();
    void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                              RTC_FORMAT_FLOAT3, sizeof(Vec3f), vertices);
    std::memcpy(positions, instance.positions.data(), vertices * sizeof(Vec3f));
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(Triangle), triangles);
    std::memcpy(indices, instance.mesh->triangles.data(), triangles * sizeof(Triangle));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

template <class Packet>
void load(const RayBatch& b, int first, int lanes, Packet& p) {
    const std::size_t bytes = sizeof(float) * static_cast<std::size_t>(lanes);
    std::memcpy(p.org_x, &b.origin_x[first], bytes);
    std::memcpy(p.org_y, &b.origin_y[first], bytes);
    std::memcpy(p.org_z, &b.origin_z[first], bytes);
    std::memcpy(p.dir_x, &b.direction_x[first], bytes);
    std::memcpy(p.dir_y, &b.direction_y[first], bytes);
    std::memcpy(p.dir_z, &b.direction_z[first], bytes);
    std::memcpy(p.tfar, &b.far_limit[first], bytes);
    for (int i = 0; i < lanes; ++i) {
        p.tnear[i] = 0;
        p.time[i] = 0;
        p.mask[i] = ~0u;
        p.id[i] = 0;
        p.flags[i] = 0;
    }
}

RTCRay single(const RayBatch& b, int i) {
    RTCRay ray{};
    ray.org_x = b.origin_x[i];
    ray.org_y = b.origin_y[i];
    ray.org_z = b.origin_z[i];
    ray.dir_x = b.direction_x[i];
    ray.dir_y = b.direction_y[i];
    ray.dir_z = b.direction_z[i];
    ray.tfar = b.far_limit[i];
    ray.mask = ~0u;
    return ray;
}

// The memory of a stream, one per worker.
struct Stream {
    std::vector<float> near_limit, time, far_limit;
    std::vector<unsigned> mask, id, flags;
    void resize(std::size_t n) {
        if (near_limit.size() >= n) return;
        near_limit.assign(n, 0.0f);
        time.assign(n, 0.0f);
        far_limit.resize(n);
        mask.assign(n, ~0u);
        id.assign(n, 0u);
        flags.assign(n, 0u);
    }
};

void occlude_stream(RTCScene scene, RTCIntersectContext& context, const RayBatch& b, Stream& s) {
    s.resize(static_cast<std::size_t>(b.size()));
    std::copy(b.far_limit.begin(), b.far_limit.end(), s.far_limit.begin());
    const auto mutable_pointer = [](const std::vector<float>& v) {
        return const_cast<float*>(v.data());
    };
    RTCRayNp rays{.org_x = mutable_pointer(b.origin_x),
                  .org_y = mutable_pointer(b.origin_y),
                  .org_z = mutable_pointer(b.origin_z),
                  .tnear = s.near_limit.data(),
                  .dir_x = mutable_pointer(b.direction_x),
                  .dir_y = mutable_pointer(b.direction_y),
                  .dir_z = mutable_pointer(b.direction_z),
                  .time = s.time.data(),
                  .tfar = s.far_limit.data(),
                  .mask = s.mask.data(),
                  .id = s.id.data(),
                  .flags = s.flags.data()};
    rtcOccludedNp(scene, &context, &rays, static_cast<unsigned>(b.count));
}

void occlude_batch(RTCScene scene, const RayBatch& b, Call call, Stream& stream) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);  // incoherent
    switch (call) {
        case Call::kSingle:
            for (int i = 0; i < b.count; ++i) {
                RTCRay ray = single(b, i);
                rtcOccluded1(scene, &context, &ray);
            }
            return;
        case Call::kPacket8:
            for (int i = 0; i < b.size(); i += 8) {
                alignas(64) RTCRay8 packet;
                load(b, i, 8, packet);
                rtcOccluded8(kAllValid, scene, &context, &packet);
            }
            return;
        case Call::kPacket16:
            for (int i = 0; i < b.size(); i += 16) {
                alignas(64) RTCRay16 packet;
                load(b, i, 16, packet);
                rtcOccluded16(kAllValid, scene, &context, &packet);
            }
            return;
        case Call::kStream:
            return occlude_stream(scene, context, b, stream);
    }
}

template <class Packet, class Function>
void intersect_packets(RTCScene scene, const RayBatch& b, int lanes, Function intersect) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (int i = 0; i < b.size(); i += lanes) {
        alignas(64) Packet packet;
        load(b, i, lanes, packet.ray);
        std::fill_n(packet.hit.geomID, lanes, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(packet.hit.instID[0], lanes, RTC_INVALID_GEOMETRY_ID);
        intersect(kAllValid, scene, &context, &packet);
    }
}

void intersect_batch(RTCScene scene, const RayBatch& b, Call call) {
    if (call == Call::kPacket8) return intersect_packets<RTCRayHit8>(scene, b, 8, rtcIntersect8);
    if (call == Call::kPacket16)
        return intersect_packets<RTCRayHit16>(scene, b, 16, rtcIntersect16);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (int i = 0; i < b.count; ++i) {
        RTCRayHit ray{};
        ray.ray = single(b, i);
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &ray);
    }
}

}  // namespace

const char* name(Call call) {
    switch (call) {
        case Call::kSingle:
            return "single";
        case Call::kPacket8:
            return "8-packets";
        case Call::kPacket16:
            return "16-packets";
        case Call::kStream:
            return "stream";
    }
    return "";
}

void RayBatch::add(const Vec3f& origin, const Vec3f& direction, float far) {
    origin_x.push_back(origin.x);
    origin_y.push_back(origin.y);
    origin_z.push_back(origin.z);
    direction_x.push_back(direction.x);
    direction_y.push_back(direction.y);
    direction_z.push_back(direction.z);
    far_limit.push_back(far);
    ++count;
}

void RayBatch::pad() {
    const int real = count;
    while (size() % 16 != 0) add({0, 0, 0}, {0, 0, 1}, -std::numeric_limits<float>::infinity());
    count = real;
}

BareEmbree::BareEmbree(const SceneView& view, const char* isa, int threads)
    : device_(rtcNewDevice(fmt::format("isa={},threads={}", isa, threads).c_str())),
      scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
    for (const Instance& instance : view.instances) attach(device_, scene_, instance);
    rtcCommitScene(scene_);
}

BareEmbree::~BareEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

double BareEmbree::occlude(const std::vector<RayBatch>& batches, Call call,
                           const parallel::Arena& arena) const {
    std::vector<Stream> streams(static_cast<std::size_t>(arena.threads()));
    const profile::Stopwatch watch;
    arena.for_each(static_cast<int>(batches.size()), [&](int index, int worker) {
        occlude_batch(scene_, batches[static_cast<std::size_t>(index)], call,
                      streams[static_cast<std::size_t>(worker)]);
    });
    return watch.seconds();
}

double BareEmbree::intersect(const std::vector<RayBatch>& batches, Call call,
                             const parallel::Arena& arena) const {
    const profile::Stopwatch watch;
    arena.for_each(static_cast<int>(batches.size()), [&](int index, int) {
        intersect_batch(scene_, batches[static_cast<std::size_t>(index)], call);
    });
    return watch.seconds();
}

}  // namespace penumbra::benchmarks
