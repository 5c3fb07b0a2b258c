#include "tests/renderer/gbuffer_agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "apps/renderer/tile_scratch.h"
#include "core/parallel/tiles.h"
#include "core/scene/cutout.h"
#include "raster/resolve.h"
#include "shadow/embree.h"

namespace penumbra::tests {
namespace {

constexpr std::size_t kExamples = 20;
constexpr double kHalfUlp = 0x1p-24;

// ---- rays --------------------------------------------------------------------------------------

struct Hit {
    std::uint32_t instance = kNothing, triangle = kNothing;
    float depth = 0;
    Vec3f normal{};
    [[nodiscard]] bool any() const { return instance != kNothing; }
    [[nodiscard]] bool same_triangle(const Hit& other) const {
        return instance == other.instance && triangle == other.triangle;
    }
};

CutoutMap opacity_of(const SceneView& view, const Instance& instance, std::uint32_t triangle) {
    const std::uint16_t slot = instance.mesh->triangle_slots[triangle];
    const int texture = view.materials[instance.materials[slot]].opacity_map;
    if (texture == kNoTexture || instance.mesh->uvs.empty()) return {};
    const Texture& map = view.textures[static_cast<std::size_t>(texture)];
    const Texture::Level& level = map.levels.front();
    return {reinterpret_cast<const std::int32_t*>(map.texels.data()) + level.offset, level.width,
            level.height};
}

struct InstanceOfView {
    const SceneView* view;
    const Instance* instance;
};

void drop_hits_in_holes(const RTCFilterFunctionNArguments* arguments) {
    const auto& of = *static_cast<const InstanceOfView*>(arguments->geometryUserPtr);
    const auto& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);  // one at a time
    const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
    const CutoutMap map = opacity_of(*of.view, *of.instance, hit.primID);
    if (map.texels == nullptr) return;
    const auto& [a, b, c] = of.instance->mesh->triangles[hit.primID].vertex;
    const std::vector<Vec3f>& p = of.instance->positions;
    const std::vector<Vec2f>& uv = of.instance->mesh->uvs;
    const Vec2f uvs[3] = {uv[a], uv[b], uv[c]};
    const Vec3f eye{ray.org_x, ray.org_y, ray.org_z};
    const Vec3f direction{ray.dir_x, ray.dir_y, ray.dir_z};
    if (!is_opaque<float>(map, relative_triangle(eye, p[a], p[b], p[c]), uvs, direction))
        arguments->valid[0] = 0;
}

class RayTracer {
  public:
    RayTracer(const SceneView& view, int threads)
        : view_(view), device_(rtcNewDevice(fmt::format("threads={}", threads).c_str())) {
        scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        for (const Instance& instance : view.instances) attach(instance);
        rtcCommitScene(scene_);
    }
    ~RayTracer() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    RayTracer(const RayTracer&) = delete;
    RayTracer& operator=(const RayTracer&) = delete;

    // The direction has view depth 1, so that the ray's length is the hit's view depth.
    [[nodiscard]] Hit trace(const Vec3f& direction) const {
        RTCRayHit ray{};
        ray.ray.org_x = view_.camera.eye.x;
        ray.ray.org_y = view_.camera.eye.y;
        ray.ray.org_z = view_.camera.eye.z;
        ray.ray.dir_x = direction.x;
        ray.ray.dir_y = direction.y;
        ray.ray.dir_z = direction.z;
        ray.ray.tnear = view_.camera.near_distance;
        ray.ray.tfar = std::numeric_limits<float>::infinity();
        ray.ray.mask = ~0u;
        ray.hit.geomID = ray.hit.primID = RTC_INVALID_GEOMETRY_ID;
        embree::Query query(embree::Order::kIncoherent);
        embree::intersect(scene_, query, ray);
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
        return {ray.hit.geomID,
                ray.hit.primID,
                ray.ray.tfar,
                {ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z}};
    }

  private:
    void attach(const Instance& instance) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        const Mesh& mesh = *instance.mesh;
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   instance.positions.data(), 0, sizeof(Vec3f),
                                   mesh.positions.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   mesh.triangles.data(), 0, sizeof(Triangle),
                                   mesh.triangles.size());
        const auto has_holes = [&](std::uint32_t material) {
            return view_.materials[material].opacity_map != kNoTexture;
        };
        if (std::any_of(instance.materials.begin(), instance.materials.end(), has_holes)) {
            filtered_.push_back(
                std::make_unique<InstanceOfView>(InstanceOfView{&view_, &instance}));
            rtcSetGeometryUserData(geometry, filtered_.back().get());
            rtcSetGeometryIntersectFilterFunction(geometry, drop_hits_in_holes);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
    }

    const SceneView& view_;
    std::vector<std::unique_ptr<InstanceOfView>> filtered_;
    RTCDevice device_;
    RTCScene scene_;
};

// ---- a triangle behind a pixel, in double precision
// ----------------------------------------------

Vec3d to_double(const Vec3f& v) {
    return {v.x, v.y, v.z};
}

struct PixelTriangle {
    Vec3d corners[3];  // right, up, forward
    Vec3d direction;   // through the pixel centre, view depth 1
    Vec3d normal;      // not a unit vector

    PixelTriangle(const SceneView& view, const Hit& hit, double x, double y) {
        const Camera& camera = view.camera;
        const Instance& instance = view.instances[hit.instance];
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t vertex = instance.mesh->triangles[hit.triangle].vertex[k];
            const Vec3d d = to_double(instance.positions[vertex]) - to_double(camera.eye);
            corners[k] = {dot(d, to_double(camera.right)), dot(d, to_double(camera.up)),
                          dot(d, to_double(camera.forward))};
        }
        direction = {(x - camera.center_x) / camera.focal, (camera.center_y - y) / camera.focal, 1};
        normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    }

    [[nodiscard]] double depth() const { return dot(normal, corners[0]) / dot(normal, direction); }
    [[nodiscard]] double reach() const {
        return std::max({length(corners[0]), length(corners[1]), length(corners[2])});
    }
    // What a rounding of the vertices can do to the depth, and to the normal (in radians).
    [[nodiscard]] double depth_rounding() const {
        return kHalfUlp * reach() * length(normal) / std::abs(dot(normal, direction));
    }
    [[nodiscard]] double normal_rounding() const {
        double longest = 0;
        for (int k = 0; k < 3; ++k)
            longest = std::max(longest, length(corners[(k + 1) % 3] - corners[k]));
        return kHalfUlp * (1 + reach() * longest / length(normal));
    }
    // Pixels to the border of what the near plane leaves of the triangle.
    [[nodiscard]] double border_distance(const Camera& camera) const;
};

double segment_distance(const Camera& camera, const Vec3d& direction, const Vec3d& a,
                        const Vec3d& b) {
    const double ax = camera.focal * (a.x / a.z - direction.x);
    const double ay = camera.focal * (a.y / a.z - direction.y);
    const double bx = camera.focal * (b.x / b.z - direction.x);
    const double by = camera.focal * (b.y / b.z - direction.y);
    const double squared = (bx - ax) * (bx - ax) + (by - ay) * (by - ay);
    const double t = squared > 0 ? -(ax * (bx - ax) + ay * (by - ay)) / squared : 0;
    const double s = std::clamp(t, 0.0, 1.0);
    return std::hypot(ax + s * (bx - ax), ay + s * (by - ay));
}

double PixelTriangle::border_distance(const Camera& camera) const {
    const double near = camera.near_distance;
    Vec3d polygon[4];
    int count = 0;
    for (int k = 0; k < 3; ++k) {
        const Vec3d& a = corners[k];
        const Vec3d& b = corners[(k + 1) % 3];
        if (a.z >= near) polygon[count++] = a;
        if ((a.z >= near) != (b.z >= near))
            polygon[count++] = a + (b - a) * ((near - a.z) / (b.z - a.z));
    }
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < count; ++k)
        least = std::min(least,
                         segment_distance(camera, direction, polygon[k], polygon[(k + 1) % count]));
    return least;
}

// ---- comparison --------------------------------------------------------------------------------

std::string describe(const char* who, const SceneView& view, const Hit& hit, double x, double y) {
    if (!hit.any()) return fmt::format("{}: nothing", who);
    const PixelTriangle triangle(view, hit, x, y);
    return fmt::format("{}: instance {} triangle {} depth {:.9g} (double: {:.9g}) border {:.4g} px",
                       who, hit.instance, hit.triangle, hit.depth, triangle.depth(),
                       triangle.border_distance(view.camera));
}

class Comparison {
  public:
    Comparison(const SceneView& view, Agreement& result) : view_(view), result_(result) {}

    void add(const Hit& ours, const Hit& ray, int pixel_x, int pixel_y) {
        const double x = pixel_x + 0.5;
        const double y = pixel_y + 0.5;
        ++result_.pixels;
        result_.covered += ours.any();
        std::size_t Agreement::*const kind = difference(ours, ray, x, y);
        if (kind == nullptr) {
            ++result_.agreeing;
        } else if (near_edge(ours, x, y) || near_edge(ray, x, y)) {
            ++result_.near_edge;
        } else if (same_depth(ours, ray, x, y)) {
            ++result_.same_depth;
        } else {
            ++(result_.*kind);
            if (result_.examples.size() < kExamples)
                result_.examples.push_back({pixel_x, pixel_y,
                                            describe("ours", view_, ours, x, y) + "; " +
                                                describe("ray", view_, ray, x, y)});
        }
    }

  private:
    // Null: they agree.
    std::size_t Agreement::*difference(const Hit& ours, const Hit& ray, double x, double y) {
        if (!ours.same_triangle(ray)) return &Agreement::triangle;
        if (!ours.any()) return nullptr;
        const PixelTriangle triangle(view_, ours, x, y);
        const double depth_error =
            std::abs(double{ours.depth} - ray.depth) / triangle.depth_rounding();
        if (!(depth_error <= kDepthRoundings)) return &Agreement::depth;
        const Vec3d normal = to_double(ours.normal);
        const double normal_error =
            length(cross(normal, normalize(to_double(ray.normal)))) / triangle.normal_rounding();
        // Unit length, and towards the viewer unless seen edge-on.
        const Camera& camera = view_.camera;
        const Vec3d direction = to_double(camera.right) * triangle.direction.x +
                                to_double(camera.up) * triangle.direction.y +
                                to_double(camera.forward);
        const double slack = kNormalRoundings * triangle.normal_rounding();
        const bool fits = normal_error <= kNormalRoundings &&
                          std::abs(length(normal) - 1) < 4 * kHalfUlp * 2 &&
                          dot(normal, direction) <= slack * length(direction);
        if (!fits) return &Agreement::normal;
        result_.worst_depth = std::max(result_.worst_depth, depth_error);
        result_.worst_normal = std::max(result_.worst_normal, normal_error);
        return nullptr;
    }

    [[nodiscard]] bool near_edge(const Hit& hit, double x, double y) const {
        return hit.any() &&
               PixelTriangle(view_, hit, x, y).border_distance(view_.camera) < kEdgePixels;
    }

    [[nodiscard]] bool same_depth(const Hit& a, const Hit& b, double x, double y) const {
        if (!a.any() || !b.any() || a.same_triangle(b)) return false;
        const double depth_a = PixelTriangle(view_, a, x, y).depth();
        const double depth_b = PixelTriangle(view_, b, x, y).depth();
        return std::abs(depth_a - depth_b) < kSameDepth * std::abs(depth_a);
    }

    const SceneView& view_;
    Agreement& result_;
};

void add(const Agreement& part, Agreement& sum) {
    for (const auto member :
         {&Agreement::pixels, &Agreement::covered, &Agreement::agreeing, &Agreement::near_edge,
          &Agreement::same_depth, &Agreement::triangle, &Agreement::depth, &Agreement::normal})
        sum.*member += part.*member;
    sum.worst_depth = std::max(sum.worst_depth, part.worst_depth);
    sum.worst_normal = std::max(sum.worst_normal, part.worst_normal);
    for (const Disagreement& example : part.examples)
        if (sum.examples.size() < kExamples) sum.examples.push_back(example);
}

Hit hit_of(const ConstSurfaceView& surface, int x, int y) {
    if (surface.instance.at(x, y) == kNothing) return {};
    return {surface.instance.at(x, y),
            surface.triangle.at(x, y),
            surface.depth.at(x, y),
            {surface.geometric_normal[0].at(x, y), surface.geometric_normal[1].at(x, y),
             surface.geometric_normal[2].at(x, y)}};
}

}  // namespace

Agreement compare_with_rays(const Scene& scene, const AgreementSettings& settings) {
    const parallel::Arena arena(settings.threads);
    const FrameContext context{.width = settings.width,
                               .height = settings.height,
                               .frame = settings.frame,
                               .isa = simd::best_isa()};
    SceneView view;
    evaluate(scene, times_of_frame(scene.animation, settings.frame),
             {.width = settings.width, .height = settings.height}, view);
    const parallel::TileGrid grid({.x0 = 0, .y0 = 0, .x1 = context.width, .y1 = context.height});
    raster::Geometry geometry;
    raster::prepare(view, context, grid.window, arena, geometry);
    const RayTracer tracer(view, settings.threads);

    std::vector<renderer::TileScratch> scratch(static_cast<std::size_t>(arena.threads()));
    std::vector<Agreement> of_tiles(static_cast<std::size_t>(grid.count()));
    arena.for_each(grid.count(), [&](int index, int worker) {
        const Tile tile = grid.tile(index);
        renderer::TileScratch& s = scratch[static_cast<std::size_t>(worker)];
        raster::rasterize(view, geometry, tile, context.isa, s.raster, s.visibility());
        raster::resolve(view, geometry, context, tile, s.visibility(), s.surface());
        const ConstSurfaceView surface = to_const(s.surface());
        Comparison comparison(view, of_tiles[static_cast<std::size_t>(index)]);
        for (int y = 0; y < std::min(kTileSize, context.height - tile.y0); ++y)
            for (int x = 0; x < std::min(kTileSize, context.width - tile.x0); ++x) {
                const Vec3f direction = view.camera.direction(
                    static_cast<float>(tile.x0 + x) + 0.5f, static_cast<float>(tile.y0 + y) + 0.5f);
                comparison.add(hit_of(surface, x, y), tracer.trace(direction), tile.x0 + x,
                               tile.y0 + y);
            }
    });
    Agreement sum;
    for (const Agreement& part : of_tiles) add(part, sum);
    return sum;
}

}  // namespace penumbra::tests
