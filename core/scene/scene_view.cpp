#include "core/scene/scene_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/math/portable.h"
#include "core/math/widen.h"
#include "core/parallel/arena.h"
#include "core/scene/camera_check.h"
#include "core/scene/light_polygon.h"

namespace penumbra {
namespace {

static_assert(kMaxPolygonVertices == kMaxLightVertices);

// Beyond this many metres products of distances leave the range of float.
constexpr float kLargestCoordinate = 1e9f;
// The default near distance, of the scene's diagonal and of the distance to the camera's target:
// far below what one sees, far above the rounding of positions.
constexpr double kNearPerDiagonal = 1e-4;
constexpr double kNearPerTargetDistance = 1e-2;

// Plain products and sums: what is not in a kernel has no fused multiply-add without a call.
struct Transform {
    Vec3d x, y, z, translation;

    explicit Transform(const Affine3f& a)
        : x(widen(a.column_x)),
          y(widen(a.column_y)),
          z(widen(a.column_z)),
          translation(widen(a.translation)) {}
    Transform(const Vec3d& cx, const Vec3d& cy, const Vec3d& cz, const Vec3d& t)
        : x(cx), y(cy), z(cz), translation(t) {}

    [[nodiscard]] Vec3d vector(const Vec3d& v) const { return x * v.x + y * v.y + z * v.z; }
    [[nodiscard]] Vec3d point(const Vec3d& p) const { return vector(p) + translation; }
    [[nodiscard]] double determinant() const { return dot(x, cross(y, z)); }
    [[nodiscard]] Affine3f rounded() const {
        return {narrow(x), narrow(y), narrow(z), narrow(translation)};
    }
};

// The rows of the inverse are the cofactors over the determinant.
Transform inverse(const Transform& t) {
    const double d = t.determinant();
    const Vec3d row_x = cross(t.y, t.z) / d;
    const Vec3d row_y = cross(t.z, t.x) / d;
    const Vec3d row_z = cross(t.x, t.y) / d;
    const Transform linear({row_x.x, row_y.x, row_z.x}, {row_x.y, row_y.y, row_z.y},
                           {row_x.z, row_y.z, row_z.z}, {0, 0, 0});
    return {linear.x, linear.y, linear.z, -linear.vector(t.translation)};
}

Transform product(const Transform& a, const Transform& b) {
    return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.translation)};
}

// Normals go with the inverse transpose, here the cofactors times the determinant's sign: a
// mirrored normal still points outside. Scaled to spare tiny transforms an underflow.
Transform normal_transform(const Transform& t) {
    const double sign = t.determinant() < 0 ? -1 : 1;
    const double scale = 1 / std::max({length(t.x), length(t.y), length(t.z)});
    const Vec3d x = t.x * scale;
    const Vec3d y = t.y * scale;
    const Vec3d z = t.z * scale;
    return {cross(y, z) * sign, cross(z, x) * sign, cross(x, y) * sign, {0, 0, 0}};
}

void grow(Vec3f& low, Vec3f& high, const Vec3f& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

constexpr float kBeyondAll = std::numeric_limits<float>::infinity();
constexpr Vec3f kEmptyLow{kBeyondAll, kBeyondAll, kBeyondAll};
constexpr Vec3f kEmptyHigh{-kBeyondAll, -kBeyondAll, -kBeyondAll};

void place_mesh(const Mesh& mesh, const Transform& transform, Instance& instance) {
    const Transform normals = normal_transform(transform);
    const std::size_t count = mesh.positions.size();
    instance.positions.resize(count + 1);
    instance.normals.resize(count);
    instance.bounds_min = kEmptyLow;
    instance.bounds_max = kEmptyHigh;
    for (std::size_t i = 0; i < count; ++i) {
        instance.positions[i] = narrow(transform.point(widen(mesh.positions[i])));
        grow(instance.bounds_min, instance.bounds_max, instance.positions[i]);
        const Vec3d n = normals.vector(widen(mesh.normals[i]));
        instance.normals[i] = narrow(n * (1 / std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z)));
    }
    instance.positions[count] = Vec3f{0, 0, 0};
}

bool within_range(const Vec3f& low, const Vec3f& high) {
    const auto inside = [](float x) { return x >= -kLargestCoordinate && x <= kLargestCoordinate; };
    return inside(low.x) && inside(low.y) && inside(low.z) && inside(high.x) && inside(high.y) &&
           inside(high.z);
}

void evaluate_instance(const Scene& scene, const Model& model, EvaluateTimes times,
                       Instance& instance) {
    const Mesh& mesh = scene.meshes[model.mesh];
    const Affine3f now = evaluate(model.transform, times.now);
    const Affine3f before = evaluate(model.transform, times.previous);
    const bool fresh =
        instance.mesh != &mesh || instance.positions.size() != mesh.positions.size() + 1;
    instance.moved = fresh || !(instance.world_from_object == now);
    instance.mesh = &mesh;
    instance.materials = model.materials;
    instance.world_from_object = now;
    instance.is_animated = model.transform.moves();
    const Transform transform(now);
    instance.flips_winding = transform.determinant() < 0;
    instance.previous_from_current =
        before == now ? Affine3f{} : product(Transform(before), inverse(transform)).rounded();
    if (instance.moved) place_mesh(mesh, transform, instance);
    if (!within_range(instance.bounds_min, instance.bounds_max))
        throw InputError(scene.file, fmt::format("model '{}'", model.name),
                         fmt::format("reaches beyond {:g} metres", kLargestCoordinate));
}

// Without a shape, hence without light, where the vertices coincide once they are rounded.
PolygonLight make_light(std::span<const Vec3d> vertices, bool two_sided, const Vec3f& radiance) {
    PENUMBRA_ASSERT(vertices.size() <= kMaxPolygonVertices, "{} vertices", vertices.size());
    Vec3f rounded[kMaxPolygonVertices];
    std::transform(vertices.begin(), vertices.end(), rounded, narrow);
    PolygonLight light;
    if (static_cast<float>(length(newell_normal(vertices)) / 2) > 0)
        light.shape = make_polygon_shape(rounded, static_cast<int>(vertices.size()), two_sided);
    if (!(light.shape.area > 0)) light.shape = {};
    light.emission.radiance = radiance;
    return light;
}

// The affine map that takes a polygon's plane, its first three vertices and its normal, to
// another's.
Affine3f map_between(std::span<const Vec3d> from, std::span<const Vec3d> to) {
    const auto frame = [](std::span<const Vec3d> v) {
        const Vec3d u = v[1] - v[0], w = v[2] - v[0], n = normalize(newell_normal(v));
        return glm::dmat3(u.x, u.y, u.z, w.x, w.y, w.z, n.x, n.y, n.z);
    };
    const glm::dmat3 linear = frame(to) * glm::inverse(frame(from));
    const auto column = [&](int i) { return Vec3d{linear[i].x, linear[i].y, linear[i].z}; };
    const Vec3d moved = column(0) * from[0].x + column(1) * from[0].y + column(2) * from[0].z;
    return {narrow(column(0)), narrow(column(1)), narrow(column(2)), narrow(to[0] - moved)};
}

// Rects and polygons.
template <class Track>
PolygonLight evaluate_light(const Light& light, const Track& track, EvaluateTimes times) {
    const std::vector<Vec3d> vertices = vertices_at(track, times.now);
    PolygonLight result =
        make_light(vertices, light.two_sided, evaluate(light.emission.radiance, times.now));
    const std::vector<Vec3d> before = vertices_at(track, times.previous);
    const auto same = [](const Vec3d& a, const Vec3d& b) {
        return a.x == b.x && a.y == b.y && a.z == b.z;
    };
    const bool moved = !std::equal(vertices.begin(), vertices.end(), before.begin(), same);
    if (moved && !polygon_problem(before))
        result.previous_from_current = map_between(vertices, before);
    result.visible = light.visible;
    return result;
}

PolygonLight place_emitter(const Emitter& emitter, const Instance& instance) {
    const Transform transform(instance.world_from_object);
    std::vector<Vec3d> vertices;
    vertices.reserve(static_cast<std::size_t>(emitter.polygon.vertex_count));
    for (int i = 0; i < emitter.polygon.vertex_count; ++i)
        vertices.push_back(
            transform.point(widen(emitter.polygon.vertices[static_cast<std::size_t>(i)])));
    if (instance.flips_winding) std::reverse(vertices.begin(), vertices.end());
    PolygonLight light = make_light(vertices, false, emitter.radiance);
    light.visible = false;
    light.is_geometry = true;
    return light;
}

void evaluate_lights(const Scene& scene, EvaluateTimes times, SceneView& view) {
    view.lights.clear();
    for (const Light& light : scene.lights) {
        if (const auto problem = shape_problem(light.shape, times.now))
            throw InputError(scene.file, fmt::format("light '{}'", light.name),
                             fmt::format("at {:g} s {}", times.now, *problem));
        std::visit([&](const auto& track) { view.lights.add(evaluate_light(light, track, times)); },
                   light.shape);
    }
    for (const Emitter& emitter : scene.emitters) {
        const PolygonLight light = place_emitter(emitter, view.instances[emitter.model]);
        if (light.shape.area > 0) view.lights.add(light);  // else shrunk below float's range
    }
}

Camera evaluate_camera(const Scene& scene, double time, FilmSize film, double diagonal) {
    const CameraTracks& tracks = scene.camera;
    const Vec3d eye = widen(evaluate(tracks.eye, time));
    const Vec3d towards = widen(evaluate(tracks.target, time)) - eye;
    const Vec3d up = widen(evaluate(tracks.up, time));
    const double distance = length(towards);
    if (const auto problem = camera_problem(tracks, time))
        throw InputError(scene.file, "camera", fmt::format("at {:g} s {}", time, *problem));
    const Vec3d forward = towards / distance;
    const Vec3d right = normalize(cross(towards, up));
    const double half_angle =
        double{evaluate(tracks.vertical_field_of_view, time)} * (std::numbers::pi / 360);
    const double near_distance =
        std::min(kNearPerDiagonal * diagonal, kNearPerTargetDistance * distance);
    return {.eye = narrow(eye),
            .right = narrow(right),
            .up = narrow(cross(right, forward)),
            .forward = narrow(forward),
            .focal = static_cast<float>(0.5 * film.height / portable::tan(half_angle)),
            .center_x = 0.5f * static_cast<float>(film.width),
            .center_y = 0.5f * static_cast<float>(film.height),
            .near_distance = tracks.near_distance.value_or(static_cast<float>(
                diagonal > 0 ? near_distance : kNearPerTargetDistance * distance))};
}

}  // namespace

EvaluateTimes times_of_frame(const Animation& animation, int frame) {
    return {.now = animation.seconds(frame), .previous = animation.seconds(frame - 1.0)};
}

void evaluate(const Scene& scene, EvaluateTimes times, FilmSize film, SceneView& reuse) {
    const parallel::FlushDenormals flush;
    SceneView& view = reuse;
    view.materials = scene.materials;
    view.textures = scene.textures;
    view.background = scene.background;
    view.instances.resize(scene.models.size());
    Vec3f low = kEmptyLow;
    Vec3f high = kEmptyHigh;
    for (std::size_t i = 0; i < scene.models.size(); ++i) {
        evaluate_instance(scene, scene.models[i], times, view.instances[i]);
        grow(low, high, view.instances[i].bounds_min);
        grow(low, high, view.instances[i].bounds_max);
    }
    const bool empty = scene.models.empty();
    view.bounds_min = empty ? Vec3f{0, 0, 0} : low;
    view.bounds_max = empty ? Vec3f{0, 0, 0} : high;
    evaluate_lights(scene, times, view);
    const double diagonal = length(widen(view.bounds_max) - widen(view.bounds_min));
    view.camera = evaluate_camera(scene, times.now, film, diagonal);
    // A camera without a direction a frame ago is no fault of this frame: nothing moved, then.
    view.previous_camera = camera_problem(scene.camera, times.previous)
                               ? view.camera
                               : evaluate_camera(scene, times.previous, film, diagonal);
}

}  // namespace penumbra
