#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "core/math/widen.h"
#include "shadow/embree.h"
#include "tests/raster/scenes.h"

// The rasterizer against rays through the same pixel centres. Where the two name different
// triangles, that must be because the pixel lies within 1/100 pixel of an edge of one of them, or
// because both surfaces are within 1e-5 relative depth; decided in double precision.

using namespace penumbra;
using namespace penumbra::raster;
using namespace penumbra::raster::testing;

namespace {

constexpr double kEdgePixels = 0.01;
constexpr double kSameDepth = 1e-5;

struct Hit {
    std::uint32_t instance = 0xFFFFFFFFu, triangle = 0xFFFFFFFFu;
    float distance = 0;  // in units of the direction: view depth
};

class RayTracer {
  public:
    explicit RayTracer(const SceneView& view) : view_(view) {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        for (const Instance& instance : view.instances) attach(instance);
        rtcCommitScene(scene_);
    }
    ~RayTracer() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    RayTracer(const RayTracer&) = delete;

    [[nodiscard]] Hit trace(int x, int y) const {
        const Vec3f d = view_.camera.direction(x + 0.5f, y + 0.5f);
        RTCRayHit ray{};
        ray.ray.org_x = view_.camera.eye.x;
        ray.ray.org_y = view_.camera.eye.y;
        ray.ray.org_z = view_.camera.eye.z;
        ray.ray.dir_x = d.x;
        ray.ray.dir_y = d.y;
        ray.ray.dir_z = d.z;
        ray.ray.tnear = view_.camera.near_distance;
        ray.ray.tfar = 1e30f;
        ray.ray.mask = 0xFFFFFFFFu;
        ray.hit.geomID = ray.hit.primID = RTC_INVALID_GEOMETRY_ID;
        embree::Query query(embree::Order::kIncoherent);
        embree::intersect(scene_, query, ray);
        return {ray.hit.geomID, ray.hit.primID, ray.ray.tfar};
    }

  private:
    void attach(const Instance& instance) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        const Mesh& mesh = *instance.mesh;
        void* const vertices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    sizeof(Vec3f), mesh.positions.size());
        std::copy_n(instance.positions.data(), mesh.positions.size(),
                    static_cast<Vec3f*>(vertices));
        void* const indices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    sizeof(Triangle), mesh.triangles.size());
        std::copy_n(mesh.triangles.data(), mesh.triangles.size(), static_cast<Triangle*>(indices));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
    }

    const SceneView& view_;
    RTCDevice device_ = rtcNewDevice("threads=1");
    RTCScene scene_ = rtcNewScene(device_);
};

struct Corners {
    Vec3d view[3];
};
Corners corners(const SceneView& scene, std::uint32_t instance, std::uint32_t triangle) {
    const Camera& camera = scene.camera;
    Corners result;
    for (int k = 0; k < 3; ++k) {
        const Triangle& t = scene.instances[instance].mesh->triangles[triangle];
        const Vec3d d = widen(scene.instances[instance].positions[t.vertex[k]]) - widen(camera.eye);
        result.view[k] = {dot(d, widen(camera.right)), dot(d, widen(camera.up)),
                          dot(d, widen(camera.forward))};
    }
    return result;
}

// Pixels from a pixel centre to the triangle's border, clipped to the near plane.
double border_distance(const SceneView& scene, const Corners& triangle, int x, int y) {
    const Camera& camera = scene.camera;
    const double near_z = camera.near_distance;
    double least = 1e30;
    for (int k = 0; k < 3; ++k) {
        Vec3d a = triangle.view[k], b = triangle.view[(k + 1) % 3];
        if (a.z < near_z && b.z < near_z) continue;
        if (a.z < near_z) a = a + (b - a) * ((near_z - a.z) / (b.z - a.z));
        if (b.z < near_z) b = b + (a - b) * ((near_z - b.z) / (a.z - b.z));
        const double ax = camera.center_x + camera.focal * a.x / a.z - (x + 0.5);
        const double ay = camera.center_y - camera.focal * a.y / a.z - (y + 0.5);
        const double bx = camera.center_x + camera.focal * b.x / b.z - (x + 0.5);
        const double by = camera.center_y - camera.focal * b.y / b.z - (y + 0.5);
        const double squared = (bx - ax) * (bx - ax) + (by - ay) * (by - ay);
        const double t = squared > 0 ? -(ax * (bx - ax) + ay * (by - ay)) / squared : 0;
        const double s = std::clamp(t, 0.0, 1.0);
        least = std::min(least, std::hypot(ax + s * (bx - ax), ay + s * (by - ay)));
    }
    return least;
}

// View depth of a triangle's plane behind a pixel centre.
double plane_depth(const SceneView& scene, const Corners& c, int x, int y) {
    const Camera& camera = scene.camera;
    const Vec3d d{(x + 0.5 - camera.center_x) / camera.focal,
                  (camera.center_y - y - 0.5) / camera.focal, 1};
    const Vec3d n = cross(c.view[1] - c.view[0], c.view[2] - c.view[0]);
    return dot(n, c.view[0]) / dot(n, d);
}

struct Comparison {
    int pixels = 0, hits = 0;
    int excluded = 0;   // different triangles, with a reason
    int different = 0;  // without one
    int wrong_depth = 0, wrong_normal = 0;
};

bool may_differ(const SceneView& scene, const Hit& a, const Hit& b, int x, int y) {
    double depths[2] = {1e30, -1e30};
    int count = 0;
    for (const Hit& hit : {a, b}) {
        if (hit.instance == 0xFFFFFFFFu) continue;
        const Corners c = corners(scene, hit.instance, hit.triangle);
        if (border_distance(scene, c, x, y) < kEdgePixels) return true;
        // On the near plane one of the two may begin to see it.
        depths[count] = plane_depth(scene, c, x, y);
        if (std::abs(depths[count] / scene.camera.near_distance - 1) < kSameDepth) return true;
        ++count;
    }
    return count == 2 && std::abs(depths[0] - depths[1]) < kSameDepth * std::abs(depths[0]);
}

Comparison compare(TestScene& scene) {
    Comparison result;
    const Frame frame = render(scene);
    const RayTracer tracer(scene.view);
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            ++result.pixels;
            const Hit ours{frame.instance.at(x, y), frame.triangle.at(x, y), frame.depth.at(x, y)};
            const Hit ray = tracer.trace(x, y);
            if (ours.instance != ray.instance || ours.triangle != ray.triangle) {
                const bool excused = may_differ(scene.view, ours, ray, x, y);
                ++(excused ? result.excluded : result.different);
                continue;
            }
            if (ours.instance == 0xFFFFFFFFu) continue;
            ++result.hits;
            const Corners c = corners(scene.view, ours.instance, ours.triangle);
            if (border_distance(scene.view, c, x, y) < kEdgePixels) continue;
            const double expected = plane_depth(scene.view, c, x, y);
            const Vec3d n = normalize(cross(c.view[1] - c.view[0], c.view[2] - c.view[0]));
            // An input coordinate's rounding moves the hit by this much along the ray.
            const double slope = std::abs(dot(n, normalize(c.view[0])));
            const double tolerance = 2e-6 * expected / std::max(slope, 1e-3);
            result.wrong_depth += std::abs(ours.distance - expected) > tolerance;
            const Vec3f g = frame.at(frame.geometric_normal, x, y);
            const Camera& camera = scene.view.camera;
            const Vec3d in_view{dot(widen(g), widen(camera.right)), dot(widen(g), widen(camera.up)),
                                dot(widen(g), widen(camera.forward))};
            result.wrong_normal += length(cross(in_view, n)) > 1e-4;
        }
    return result;
}

void check(TestScene& scene, const std::string& name) {
    const Comparison c = compare(scene);
    MESSAGE(name << ": " << c.hits << " hits of " << c.pixels << " pixels, excluded "
                 << 100.0 * c.excluded / c.pixels << " %");
    CHECK(c.hits > c.pixels / 20);
    CHECK(c.different == 0);
    CHECK(c.wrong_depth == 0);
    CHECK(c.wrong_normal == 0);
    CHECK(c.excluded < c.pixels / 50);
}

}  // namespace

TEST_CASE("meshes look to rays as they do to the rasterizer") {
    TestScene scene(320, 240, look_at({0.3f, 0.8f, 3}, {0, 0, 0}, 320, 240));
    scene.add(torus(80, 40));
    scene.add(sphere(200, 100, {0, 0.2f, 0}, 0.7f));
    check(scene, "torus and sphere");
}

TEST_CASE("soups look to rays as they do to the rasterizer") {
    const Soup soups[] = {
        {.seed = 1, .count = 2000, .spread = 1, .smallest = 0.01f, .largest = 0.3f},
        {.seed = 2, .count = 40000, .spread = 1, .smallest = 1e-3f, .largest = 0.02f},
        {.seed = 3, .count = 300, .spread = 2, .smallest = 1e-2f, .largest = 10},
    };
    for (const Soup& s : soups) {
        TestScene scene(320, 240, look_at({0.1f, 0.2f, 2.5f}, {0, 0, 0}, 320, 240));
        scene.add(soup(s));
        check(scene, "soup");
    }
}

TEST_CASE("triangles that cross the eye plane or cover the screen agree with rays") {
    TestScene scene(320, 240, look_at({0, 0, 0}, {1, 0.1f, 0.2f}, 320, 240, 80));
    scene.add(soup({.seed = 4, .count = 200, .spread = 3, .smallest = 0.5f, .largest = 20}));
    scene.add(sphere(40, 20, {0, 0, 0}, 50));
    check(scene, "around the eye");
}

TEST_CASE("tiles merge small triangles with those of their block in the scene's order") {
    // Several chunks and instances with triangles of both kinds of bins.
    TestScene scene(384, 320, look_at({0.1f, 0.2f, 2.5f}, {0, 0, 0}, 384, 320));
    for (const std::uint32_t seed : {21u, 22u}) {
        scene.add(soup(
            {.seed = seed, .count = 9000, .spread = 1.5f, .smallest = 5e-3f, .largest = 0.05f}));
        scene.add(soup({.seed = seed + 10, .count = 60, .spread = 4, .smallest = 1, .largest = 6}));
    }
    Mesh mixed =
        soup({.seed = 40, .count = 9000, .spread = 1.5f, .smallest = 5e-3f, .largest = 0.05f});
    for (std::uint32_t k = 0; k < 9000; k += 500)  // far behind, filling the screen
        for (std::uint32_t j = 0; j < 3; ++j)
            mixed.positions[3 * k + j] = Vec3f{j == 1 ? 90.0f : -30.0f, j == 2 ? 90.0f : -30.0f,
                                               -9 + 1e-3f * static_cast<float>(k)};
    scene.add(std::move(mixed));
    check(scene, "mixed sizes");
}

TEST_CASE("millimetres, kilometres and places far from the origin agree with rays") {
    for (const float scale : {1e-3f, 1e3f}) {
        TestScene scene(256, 192, look_at(Vec3f{0.3f, 0.8f, 3} * scale, {0, 0, 0}, 256, 192));
        Mesh mesh = torus(64, 32, scale, 0.4f * scale);
        scene.add(std::move(mesh));
        scene.view.camera.near_distance = 0.01f * scale;
        check(scene, "scaled");
    }
    // The positions themselves are rounded to 1/1024 here: they are what both see.
    const Vec3f far{10000, 2000, -8000};
    TestScene scene(256, 192, look_at(far + Vec3f{0.3f, 0.8f, 3}, far, 256, 192));
    Affine3f map;
    map.translation = far;
    scene.add(torus(24, 12), {0}, map);
    check(scene, "far from the origin");
}

TEST_CASE("of triangles at the same depth the first one shows") {
    TestScene scene(128, 96, look_at({0.3f, 0.4f, 3}, {0, 0, 0}, 128, 96));
    scene.add(torus(40, 20));
    scene.add(torus(40, 20));
    Mesh twice = torus(40, 20);
    const std::size_t count = twice.triangles.size();
    for (std::size_t k = 0; k < count; ++k) {
        twice.triangles.push_back(twice.triangles[k]);
        twice.triangle_slots.push_back(0);
    }
    TestScene other(128, 96, scene.view.camera);
    other.add(std::move(twice));
    const Frame a = render(scene), b = render(other);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 128; ++x) {
            REQUIRE((a.instance.at(x, y) == 0 || a.instance.at(x, y) == 0xFFFFFFFFu));
            REQUIRE(a.triangle.at(x, y) == b.triangle.at(x, y));
        }
}
