#include "shadow/occluders.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/simd/isa.h"
#include "shadow/cutout_geometry.h"
#include "shadow/embree.h"
#include "shadow/exact_occluders.h"
#include "shadow/triangle_extent.h"

namespace penumbra::shadow {
namespace {

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

std::string device_configuration(TraceIsa isa) {
    // Embree accepts names it does not know without a word: they are checked in parse_trace_isa.
    const char* const name = isa == TraceIsa::kAvx2     ? "isa=avx2,"
                             : isa == TraceIsa::kAvx512 ? "isa=avx512,"
                                                        : "";
    // No number of threads: that would be a limit for all of the process. Builds run in our arena.
    return std::string(name) + "start_threads=0,set_affinity=0";
}

void check(RTCDevice device, const char* action) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    const char* const reason =
        error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : "the ray tracer failed";
    throw OutputError(
        fmt::format("{} while {} (Embree error {})", reason, action, static_cast<int>(error)));
}

// What a geometry is made of. Equal sources give equal trees.
struct Source {
    const Mesh* mesh;
    const Vec3f* positions;  // world; null for what is instanced
    const std::uint32_t* materials;
    Affine3f world_from_object;  // identity for what is instanced
    bool is_instanced;
    friend bool operator==(const Source&, const Source&) = default;
};

std::vector<Source> sources_of(const SceneView& view) {
    std::vector<Source> sources;
    sources.reserve(view.instances.size());
    for (const Instance& instance : view.instances) {
        const bool moves = instance.is_animated;
        sources.push_back({instance.mesh, moves ? nullptr : instance.positions.data(),
                           instance.materials.data(),
                           moves ? Affine3f{} : instance.world_from_object, moves});
    }
    return sources;
}

// Embree's callback: drops hits that fall into a hole.
void drop_holes(const RTCFilterFunctionNArguments* arguments) {
    const auto& geometry = *static_cast<const CutoutGeometry*>(arguments->geometryUserPtr);
    const unsigned lanes = arguments->N;
    for (unsigned lane = 0; lane < lanes; ++lane) {
        if (arguments->valid[lane] == 0) continue;
        RTCRayN* const ray = arguments->ray;
        const Vec3f origin = {RTCRayN_org_x(ray, lanes, lane), RTCRayN_org_y(ray, lanes, lane),
                              RTCRayN_org_z(ray, lanes, lane)};
        const Vec3f direction = {RTCRayN_dir_x(ray, lanes, lane), RTCRayN_dir_y(ray, lanes, lane),
                                 RTCRayN_dir_z(ray, lanes, lane)};
        const unsigned triangle = RTCHitN_primID(arguments->hit, lanes, lane);
        if (!geometry.is_opaque_at(triangle, origin, direction)) arguments->valid[lane] = 0;
    }
}

struct VertexSource {
    const Vec3f* positions;
    std::size_t count;
    bool has_room_behind;  // may 16 bytes be read at the last vertex?
};

void set_vertices(RTCGeometry geometry, const VertexSource& vertices) {
    if (vertices.has_room_behind) {
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   vertices.positions, 0, sizeof(Vec3f), vertices.count);
        return;
    }
    void* const copy = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                               RTC_FORMAT_FLOAT3, sizeof(Vec3f), vertices.count);
    if (copy) std::copy_n(vertices.positions, vertices.count, static_cast<Vec3f*>(copy));
}

void set_triangles(RTCGeometry geometry, std::span<const Triangle> triangles) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               triangles.data(), 0, sizeof(Triangle), triangles.size());
}

void attach(RTCScene scene, const Geometry& geometry) {
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene, geometry.get());
}

void set_transform(RTCGeometry geometry, const Affine3f& world_from_object) {
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &world_from_object);
    rtcCommitGeometry(geometry);
}
static_assert(sizeof(Affine3f) == 12 * sizeof(float), "four columns of three floats");

#if RTC_VERSION_MAJOR >= 4

// Without streams: packets of 16, of which the last one is filled up with masked rays.
void occlude_by(RTCScene scene, const RayStream& rays) {
    constexpr int kPacket = 16;
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
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
        rtcOccluded16(valid, scene, &packet, &arguments);
        std::copy_n(packet.tfar, kPacket, rays.far_limit + first);
    }
}

#else

// As one stream: fewer calls than packets, and Embree gathers what its own width needs.
void occlude_by(RTCScene scene, const RayStream& rays) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    RTCRayNp stream{};
    stream.org_x = rays.origin[0];
    stream.org_y = rays.origin[1];
    stream.org_z = rays.origin[2];
    stream.dir_x = rays.direction[0];
    stream.dir_y = rays.direction[1];
    stream.dir_z = rays.direction[2];
    stream.tnear = rays.near_limit;
    stream.tfar = rays.far_limit;
    rtcOccludedNp(scene, &context, &stream, static_cast<unsigned>(rays.count));
}

#endif

}  // namespace

std::string_view name(TraceIsa isa) {
    switch (isa) {
        case TraceIsa::kAvx2:
            return "avx2";
        case TraceIsa::kAvx512:
            return "avx512";
        case TraceIsa::kAuto:
            return "auto";
    }
    return "";
}

TraceIsa parse_trace_isa(std::string_view name) {
    if (name == "auto") return TraceIsa::kAuto;
    const bool avx512 = name == "avx512";
    if (!avx512 && name != "avx2")
        throw InputError(fmt::format("trace isa: expected avx2, avx512 or auto, got \"{}\"", name));
    if (!simd::is_supported(avx512 ? simd::Isa::kAvx512 : simd::Isa::kAvx2))
        throw InputError(fmt::format("trace isa: this processor has no {}", name));
    return avx512 ? TraceIsa::kAvx512 : TraceIsa::kAvx2;
}

// One tree of world-space triangles for all that never moves. What moves has a tree of its own in
// object space, built once, and is instanced beside it: never refitted, since a refitted tree would
// depend on its history.
struct Occluders::Implementation {
    Implementation(const parallel::Arena& arena_to_use, const OccluderSettings& settings)
        : arena(arena_to_use), device(rtcNewDevice(device_configuration(settings.isa).c_str())) {
        if (!device) check(nullptr, "starting the ray tracer");
        if (settings.test == HitTest::kExact)
            exact = std::make_unique<ExactOccluders>(
                arena, settings.kernels ? *settings.kernels : simd::best_isa());
    }

    [[nodiscard]] Scene new_scene() const {
        Scene scene(rtcNewScene(device.get()));
        check(device.get(), "creating the shadow rays' tree");
        rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
        return scene;
    }

    void commit(RTCScene scene) const {
        // Not rtcJoinCommitScene: with TBB that one brings in threads of an arena of Embree's own.
        arena.run([scene] { rtcCommitScene(scene); });
        check(device.get(), "building the shadow rays' tree");
    }

    void attach_triangles(RTCScene scene, const VertexSource& vertices,
                          std::span<const Triangle> triangles, const CutoutGeometry* cutout) const {
        if (triangles.empty()) return;
        const Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
        set_vertices(geometry.get(), vertices);
        set_triangles(geometry.get(), triangles);
        if (cutout) {
            rtcSetGeometryUserData(geometry.get(), const_cast<CutoutGeometry*>(cutout));
            rtcSetGeometryOccludedFilterFunction(geometry.get(), &drop_holes);
        }
        attach(scene, geometry);
        check(device.get(), "filling the shadow rays' tree");
    }

    // Opaque triangles and those with holes are geometries of their own: only the latter ask back.
    void attach_instance(RTCScene scene, const SceneView& view, const Instance& instance,
                         const VertexSource& vertices) {
        auto split = split_cutouts(view, instance, vertices.positions);
        attach_triangles(scene, vertices, split->opaque, nullptr);
        attach_triangles(scene, vertices, split->cutout.triangles, &split->cutout);
        splits.push_back(std::move(split));
    }

    void build_fixed(const SceneView& view) {
        fixed = new_scene();
        for (const Instance& instance : view.instances)
            if (!instance.is_animated)
                attach_instance(fixed.get(), view, instance,
                                {instance.positions.data(), instance.mesh->positions.size(), true});
        commit(fixed.get());
    }

    // A model's tree; models that share mesh and materials share it.
    RTCScene moving_scene(const SceneView& view, const Instance& instance) {
        for (const Moving& other : moving)
            if (other.mesh == instance.mesh && other.materials == instance.materials.data())
                return other.scene.get();
        Scene scene = new_scene();
        attach_instance(scene.get(), view, instance,
                        {instance.mesh->positions.data(), instance.mesh->positions.size(), false});
        commit(scene.get());
        moving.push_back({instance.mesh, instance.materials.data(), std::move(scene)});
        return moving.back().scene.get();
    }

    [[nodiscard]] Geometry attach_copy(RTCScene of) const {
        Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
        rtcSetGeometryInstancedScene(geometry.get(), of);
        set_transform(geometry.get(), Affine3f{});
        rtcAttachGeometry(top.get(), geometry.get());
        return geometry;
    }

    void build_all(const SceneView& view) {
        clear();
        if (exact)
            exact->rebuild(view);
        else
            build_scenes(view);
        extents.resize(view.instances.size());
        for (std::size_t i = 0; i < view.instances.size(); ++i)
            extents[i] = triangle_extents(arena, view.instances[i]);
        check(device.get(), "building the shadow rays' tree");
    }

    void build_scenes(const SceneView& view) {
        build_fixed(view);
        const bool any_moves = std::any_of(view.instances.begin(), view.instances.end(),
                                           [](const Instance& i) { return i.is_animated; });
        if (any_moves) {
            top = new_scene();
            static_cast<void>(attach_copy(fixed.get()));
        }
        placements.resize(view.instances.size());
        for (std::size_t i = 0; i < view.instances.size(); ++i)
            if (view.instances[i].is_animated)
                placements[i].geometry = attach_copy(moving_scene(view, view.instances[i]));
    }

    void place_moving(const SceneView& view) {
        if (exact) return exact->place_moving(view);
        bool changed = false;
        for (std::size_t i = 0; i < placements.size(); ++i) {
            Placement& placement = placements[i];
            const Affine3f& now = view.instances[i].world_from_object;
            if (!placement.geometry || (placement.is_set && placement.world_from_object == now))
                continue;
            set_transform(placement.geometry.get(), now);
            placement.world_from_object = now;
            placement.is_set = changed = true;
        }
        if (changed) commit(top.get());
    }

    [[nodiscard]] RTCScene scene() const { return top ? top.get() : fixed.get(); }

    void clear() {
        placements.clear();
        top.reset();
        moving.clear();
        fixed.reset();
        splits.clear();
        extents.clear();
    }

    struct Moving {
        const Mesh* mesh;
        const std::uint32_t* materials;
        Scene scene;
    };
    struct Placement {
        Geometry geometry;  // null for what does not move
        Affine3f world_from_object;
        bool is_set = false;
    };

    const parallel::Arena& arena;
    Device device;
    std::vector<Source> sources;
    bool is_built = false;  // from `sources`
    std::vector<std::unique_ptr<CutoutSplit>> splits;
    Scene fixed;
    std::vector<Moving> moving;
    Scene top;  // null if nothing moves: then `fixed` is all
    std::vector<Placement> placements;
    std::unique_ptr<ExactOccluders> exact;  // if set, it stands for all scenes
    std::vector<TriangleExtents> extents;
    std::vector<float> scales;
};

Occluders::Occluders(const parallel::Arena& arena, const OccluderSettings& settings)
    : implementation_(std::make_unique<Implementation>(arena, settings)) {}
Occluders::~Occluders() = default;

void Occluders::update(const SceneView& view) {
    Implementation& self = *implementation_;
    std::vector<Source> sources = sources_of(view);
    if (!self.is_built || sources != self.sources) {
        self.is_built = false;
        self.sources.clear();  // after a failure, the next update begins anew
        self.build_all(view);
        self.sources = std::move(sources);
        self.is_built = true;
    }
    self.place_moving(view);
    self.scales.resize(view.instances.size());
    for (std::size_t i = 0; i < view.instances.size(); ++i)
        self.scales[i] = offset_scale(self.extents[i], view.instances[i]);
}

std::span<const float> Occluders::offset_scales() const {
    return implementation_->scales;
}

void Occluders::occlude(const RayStream& rays) const {
    const Implementation& self = *implementation_;
    if (self.exact)
        self.exact->occlude(rays);
    else
        occlude_by(self.scene(), rays);
}

}  // namespace penumbra::shadow
