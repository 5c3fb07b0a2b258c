#include "core/scene/frame_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/math/portable.h"
#include "core/math/widen.h"

namespace penumbra {
namespace {

constexpr double kFieldOfView = 35;  // degrees: little distortion
constexpr double kMargin = 1.08;     // the model leaves this much air

struct Box {
    Vec3d low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max(),
              std::numeric_limits<double>::max()};
    Vec3d high{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest(),
               std::numeric_limits<double>::lowest()};

    void grow(const Vec3d& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    [[nodiscard]] Vec3d center() const { return (low + high) * 0.5; }
    // Half the diagonal; a box that is a point frames as one of a metre.
    [[nodiscard]] double radius() const {
        const double r = length(high - low) / 2;
        return r > 0 ? r : 1;
    }
    [[nodiscard]] std::array<Vec3d, 8> corners() const {
        std::array<Vec3d, 8> result{};
        for (std::size_t i = 0; i < 8; ++i)
            result[i] = {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                         (i & 4) != 0 ? high.z : low.z};
        return result;
    }
};

Box bounds_of(const Scene& scene) {
    Box world;
    for (const Model& model : scene.models) {
        Box object;
        for (const Vec3f& p : scene.meshes[model.mesh].positions) object.grow(widen(p));
        const Affine3f transform = evaluate(model.transform, 0);
        for (const Vec3d& corner : object.corners())
            world.grow(widen(transform.point(narrow(corner))));
    }
    if (scene.models.empty()) world.grow({0, 0, 0});
    return world;
}

}  // namespace

CameraTracks framing_camera(const Scene& scene) {
    const Box box = bounds_of(scene);
    const Vec3d backward = normalize(Vec3d{0.6, 0.4, 1});
    const Vec3d right = normalize(cross(Vec3d{0, 1, 0}, backward));
    const Vec3d up = cross(backward, right);
    const double half_height = portable::tan(kFieldOfView * (std::numbers::pi / 360));
    const double half_width = half_height * scene.width / scene.height;
    // The least distance at which each corner lies within the four sides of the view.
    double distance = 0;
    for (const Vec3d& corner : box.corners()) {
        const Vec3d d = (corner - box.center()) * kMargin;
        const double sideways =
            std::max(std::fabs(dot(d, right)) / half_width, std::fabs(dot(d, up)) / half_height);
        distance = std::max(distance, dot(d, backward) + sideways);
    }
    if (!(distance > 0)) distance = box.radius() / half_height;
    return {.eye = constant(narrow(box.center() + backward * distance)),
            .target = constant(narrow(box.center())),
            .up = constant(Vec3f{0, 1, 0}),
            .vertical_field_of_view = constant(static_cast<float>(kFieldOfView)),
            .near_distance = std::nullopt};
}

Light default_light(const Scene& scene) {
    const Box box = bounds_of(scene);
    const double radius = box.radius();
    const Vec3d from_center = Vec3d{-1.0, 1.7, 1.4} * radius;
    const Vec3d normal = normalize(-from_center);
    const Vec3d u = normalize(cross(Vec3d{0, 1, 0}, normal));
    const Vec3d v = cross(normal, u);
    const double half_side = 0.8 * radius;
    Light light;
    light.name = "default light";
    light.shape = RectTrack{.center = constant(narrow(box.center() + from_center)),
                            .half_axis_u = constant(narrow(u * half_side)),
                            .half_axis_v = constant(narrow(v * half_side))};
    // The irradiance at the centre is L A / d^2 = 0.44 L whatever the radius: 10 makes a surface of
    // albedo 0.5 as bright as 0.7 where it faces the light, 0.35 where it faces the camera.
    light.emission.radiance = constant(Vec3f{10, 10, 10});
    light.visible = false;
    return light;
}

}  // namespace penumbra
