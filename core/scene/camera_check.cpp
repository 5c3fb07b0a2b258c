#include "core/scene/camera_check.h"

namespace penumbra {

std::optional<std::string> camera_problem(const CameraTracks& camera, double time) {
    const auto at = [time](const Vec3Track& track) {
        const Vec3f v = evaluate(track, time);
        return Vec3d{v.x, v.y, v.z};
    };
    const Vec3d towards = at(camera.target) - at(camera.eye);
    const Vec3d up = at(camera.up);
    if (!(length(towards) > 0)) return "\"eye\" and \"target\" coincide";
    if (!(length(up) > 0)) return "\"up\" has no length";
    // 1e-6 radians between view and up are less than float tells apart.
    if (!(length(cross(towards, up)) > 1e-6 * length(towards) * length(up)))
        return "\"up\" is parallel to the view direction";
    return std::nullopt;
}

}  // namespace penumbra
