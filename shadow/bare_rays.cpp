#include "shadow/bare_rays.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "core/error.h"
#include "shadow/embree_objects.h"

namespace penumbra::shadow {
namespace {

alignas(64) constexpr int kAllValid[16] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                           -1, -1, -1, -1, -1, -1, -1, -1};

using Query = embree::Query;
using embree::Order;

template <class Packet>
void load(const RayBatch& b, std::size_t first, std::size_t lanes, Packet& p) {
    const std::size_t bytes = sizeof(float) * lanes;
    std::memcpy(p.org_x, &b.origin_x[first], bytes);
    std::memcpy(p.org_y, &b.origin_y[first], bytes);
    std::memcpy(p.org_z, &b.origin_z[first], bytes);
    std::memcpy(p.dir_x, &b.direction_x[first], bytes);
    std::memcpy(p.dir_y, &b.direction_y[first], bytes);
    std::memcpy(p.dir_z, &b.direction_z[first], bytes);
    std::memcpy(p.tfar, &b.far_limit[first], bytes);
    std::fill_n(p.tnear, lanes, 0.0f);
    std::fill_n(p.time, lanes, 0.0f);
    std::fill_n(p.mask, lanes, ~0u);
    std::fill_n(p.id, lanes, 0u);
    std::fill_n(p.flags, lanes, 0u);
}

RTCRay single(const RayBatch& b, std::size_t i) {
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

// A blocked ray's far limit becomes -infinity; so are the padding's from the start.
bool is_blocked(float far_limit) {
    return far_limit < 0;
}

template <class Packet>
int occlude_packets(RTCScene scene, const RayBatch& b, std::size_t lanes) {
    Query query(Order::kIncoherent);
    int blocked = 0;
    for (std::size_t first = 0; first < b.far_limit.size(); first += lanes) {
        alignas(64) Packet packet;
        load(b, first, lanes, packet);
        embree::occlude(scene, query, kAllValid, packet);
        blocked += static_cast<int>(std::count_if(packet.tfar, packet.tfar + lanes, is_blocked));
    }
    return blocked - (b.size() - b.count);
}

int occlude_singles(RTCScene scene, const RayBatch& b) {
    Query query(Order::kIncoherent);
    int blocked = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.count); ++i) {
        RTCRay ray = single(b, i);
        embree::occlude(scene, query, ray);
        blocked += is_blocked(ray.tfar);
    }
    return blocked;
}

void resize(std::size_t count, RayCallScratch& s) {
    if (s.near_limit.size() >= count) return;
    s.near_limit.assign(count, 0.0f);
    s.far_limit.resize(count);
}

int occlude_stream(RTCScene scene, const RayBatch& b, RayCallScratch& s) {
    Query query(Order::kIncoherent);
    resize(b.far_limit.size(), s);
    std::copy(b.far_limit.begin(), b.far_limit.end(), s.far_limit.begin());
    // Embree writes to none but the far limits.
    const auto pointer = [](const std::vector<float>& v) { return const_cast<float*>(v.data()); };
    embree::occlude(
        scene, query,
        {.origin = {pointer(b.origin_x), pointer(b.origin_y), pointer(b.origin_z)},
         .direction = {pointer(b.direction_x), pointer(b.direction_y), pointer(b.direction_z)},
         .near_limit = s.near_limit.data(),
         .far_limit = s.far_limit.data(),
         .count = b.count});
    return static_cast<int>(
        std::count_if(s.far_limit.begin(), s.far_limit.begin() + b.count, is_blocked));
}

template <class Packet>
int intersect_packets(RTCScene scene, const RayBatch& b, std::size_t lanes) {
    Query query(Order::kCoherent);
    int hits = 0;
    for (std::size_t first = 0; first < b.far_limit.size(); first += lanes) {
        alignas(64) Packet packet;
        load(b, first, lanes, packet.ray);
        std::fill_n(packet.hit.geomID, lanes, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(packet.hit.instID[0], lanes, RTC_INVALID_GEOMETRY_ID);
        embree::intersect(scene, query, kAllValid, packet);
        hits += static_cast<int>(
            lanes - static_cast<std::size_t>(std::count(
                        packet.hit.geomID, packet.hit.geomID + lanes, RTC_INVALID_GEOMETRY_ID)));
    }
    return hits;
}

int intersect_singles(RTCScene scene, const RayBatch& b) {
    Query query(Order::kCoherent);
    int hits = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.count); ++i) {
        RTCRayHit ray{};
        ray.ray = single(b, i);
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        embree::intersect(scene, query, ray);
        hits += ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}

}  // namespace

const char* name(RayCall call) {
    switch (call) {
        case RayCall::kSingle:
            return "single";
        case RayCall::kPacket8:
            return "8-packets";
        case RayCall::kPacket16:
            return "16-packets";
        case RayCall::kStream:
            return "stream";
    }
    return "";
}

std::vector<RayCall> occlude_calls() {
    std::vector<RayCall> calls = {RayCall::kSingle, RayCall::kPacket8, RayCall::kPacket16};
    if (embree::kHasStreams) calls.push_back(RayCall::kStream);
    return calls;
}

std::vector<RayCall> intersect_calls() {
    return {RayCall::kSingle, RayCall::kPacket8, RayCall::kPacket16};
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

struct BareRays::Implementation {
    explicit Implementation(TraceIsa isa)
        : device(new_device(isa)), tree(new_scene(device.get())) {}

    Device device;
    Scene tree;
};

BareRays::BareRays(const SceneView& view, TraceIsa isa, const parallel::Arena& arena)
    : implementation_(std::make_unique<Implementation>(isa)) {
    RTCDevice device = implementation_->device.get();
    RTCScene scene = implementation_->tree.get();
    for (const Instance& instance : view.instances) {
        if (instance.mesh->triangles.empty()) continue;
        const VertexSource vertices{instance.positions.data(), instance.mesh->positions.size(),
                                    true};
        attach(scene, new_triangles(device, vertices, instance.mesh->triangles));
    }
    commit(device, scene, arena);
}

BareRays::~BareRays() = default;

int BareRays::occlude(const RayBatch& batch, RayCall call, RayCallScratch& scratch) const {
    PENUMBRA_ASSERT(batch.size() % 16 == 0, "size = {}", batch.size());
    RTCScene scene = implementation_->tree.get();
    switch (call) {
        case RayCall::kSingle:
            return occlude_singles(scene, batch);
        case RayCall::kPacket8:
            return occlude_packets<RTCRay8>(scene, batch, 8);
        case RayCall::kPacket16:
            return occlude_packets<RTCRay16>(scene, batch, 16);
        case RayCall::kStream:
            return occlude_stream(scene, batch, scratch);
    }
    return 0;
}

int BareRays::intersect(const RayBatch& batch, RayCall call) const {
    PENUMBRA_ASSERT(batch.size() % 16 == 0, "size = {}", batch.size());
    RTCScene scene = implementation_->tree.get();
    if (call == RayCall::kPacket8) return intersect_packets<RTCRayHit8>(scene, batch, 8);
    if (call == RayCall::kPacket16) return intersect_packets<RTCRayHit16>(scene, batch, 16);
    return intersect_singles(scene, batch);
}

}  // namespace penumbra::shadow
