#include "tests/renderer/embree_bits.h"

#include <cstring>

#include "core/image/plane.h"
#include "core/simd/isa.h"
#include "shadow/occluders.h"

namespace penumbra::tests {
namespace {

// The rays as structure of arrays, with room for a multiple of 16.
class Arrays {
  public:
    explicit Arrays(const std::vector<EmbreeRay>& rays) : count_(static_cast<int>(rays.size())) {
        for (int i = 0; i < kPlanes; ++i) planes_.emplace_back(count_ + 16, 1);
        for (Plane<float>& plane : planes_) plane.fill(0);
        for (int i = 0; i < count_; ++i) {
            const EmbreeRay& r = rays[static_cast<std::size_t>(i)];
            const float values[kPlanes] = {r.origin.x,    r.origin.y,    r.origin.z, r.direction.x,
                                           r.direction.y, r.direction.z, 0,          r.far_limit};
            for (int k = 0; k < kPlanes; ++k) row(k)[i] = values[k];
        }
    }
    float* row(int plane) { return planes_[static_cast<std::size_t>(plane)].row(0); }
    [[nodiscard]] int count() const { return count_; }
    shadow::RayStream stream() {
        return {.origin = {row(0), row(1), row(2)},
                .direction = {row(3), row(4), row(5)},
                .near_limit = row(6),
                .far_limit = row(7),
                .count = count_};
    }
    std::vector<bool> blocked() {
        std::vector<bool> bits;
        for (int i = 0; i < count_; ++i) bits.push_back(row(7)[i] < 0);
        return bits;
    }

  private:
    static constexpr int kPlanes = 8;
    int count_;
    std::vector<Plane<float>> planes_;
};

void attach(RTCDevice device, RTCScene scene, const Instance& instance) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t vertices = instance.mesh->positions.size();
    const std::size_t triangles = instance.mesh->triangles.size();
    void* const positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                    RTC_FORMAT_FLOAT3, sizeof(Vec3f), vertices);
    std::memcpy(positions, instance.positions.data(), vertices * sizeof(Vec3f));
    void* const indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                  RTC_FORMAT_UINT3, sizeof(Triangle), triangles);
    std::memcpy(indices, instance.mesh->triangles.data(), triangles * sizeof(Triangle));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

template <int kRays, class Ray, class Occluded>
void occlude_packets(Arrays& rays, const Occluded& occluded) {
    for (int first = 0; first < rays.count(); first += kRays) {
        alignas(64) Ray packet{};
        float* const fields[8] = {&packet.org_x[0], &packet.org_y[0], &packet.org_z[0],
                                  &packet.dir_x[0], &packet.dir_y[0], &packet.dir_z[0],
                                  &packet.tnear[0], &packet.tfar[0]};
        for (int k = 0; k < 8; ++k)
            std::memcpy(fields[k], rays.row(k) + first, kRays * sizeof(float));
        alignas(64) int valid[kRays];
        for (int i = 0; i < kRays; ++i) {
            packet.mask[i] = ~0u;
            valid[i] = first + i < rays.count() ? -1 : 0;
        }
        occluded(valid, packet);
        std::memcpy(rays.row(7) + first, &packet.tfar[0], kRays * sizeof(float));
    }
}

void occlude_single(RTCScene scene, embree::Query& query, Arrays& rays) {
    for (int i = 0; i < rays.count(); ++i) {
        RTCRay ray{};
        ray.org_x = rays.row(0)[i], ray.org_y = rays.row(1)[i], ray.org_z = rays.row(2)[i];
        ray.dir_x = rays.row(3)[i], ray.dir_y = rays.row(4)[i], ray.dir_z = rays.row(5)[i];
        ray.tfar = rays.row(7)[i];
        ray.mask = ~0u;
        embree::occlude(scene, query, ray);
        rays.row(7)[i] = ray.tfar;
    }
}

void occlude(RTCScene scene, int packet, Arrays& rays) {
    embree::Query query(embree::Order::kIncoherent);
    if (packet == 1)
        occlude_single(scene, query, rays);
    else if (packet == 0)
        embree::occlude(scene, query, rays.stream());
    else
        occlude_packets<8, RTCRay8>(
            rays, [&](const int* valid, RTCRay8& p) { embree::occlude(scene, query, valid, p); });
}

}  // namespace

std::vector<std::string> embree_isas() {
    std::vector<std::string> isas = {"sse2", "sse4.2", "avx", "avx2"};
    if (simd::is_supported(simd::Isa::kAvx512)) isas.emplace_back("avx512");
    return isas;
}

BareEmbree::BareEmbree(const SceneView& view, const std::string& isa)
    : device_(rtcNewDevice(("threads=1,isa=" + isa).c_str())), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    for (const Instance& instance : view.instances) attach(device_, scene_, instance);
    rtcCommitScene(scene_);
}

BareEmbree::~BareEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

std::vector<bool> BareEmbree::blocked(const std::vector<EmbreeRay>& rays, int rays_per_call) const {
    Arrays arrays(rays);
    const parallel::FlushDenormals flush;
    occlude(scene_, rays_per_call, arrays);
    return arrays.blocked();
}

std::vector<bool> exactly_blocked(const SceneView& view, const std::vector<EmbreeRay>& rays) {
    const parallel::Arena arena(1);
    shadow::Occluders occluders(arena, {.test = shadow::HitTest::kExact});
    occluders.update(view);
    Arrays arrays(rays);
    const parallel::FlushDenormals flush;
    occluders.occlude({{arrays.row(0), arrays.row(1), arrays.row(2)},
                       {arrays.row(3), arrays.row(4), arrays.row(5)},
                       arrays.row(6),
                       arrays.row(7),
                       arrays.count()});
    return arrays.blocked();
}

}  // namespace penumbra::tests
